// The surfaces in a GLB file: one for each mesh that has triangles.
#pragma once

#include "io/mesh_formats.h"
#include "io/polygon_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace koebe {

/// Triangles of one primitive, as part of its mesh.
struct GltfPrimitive {
    std::size_t place = 0;             ///< among the primitives of the mesh
    Index vertex_count = 0;            ///< of its vertex attributes
    std::vector<Index> corner_vertex;  ///< (3F) among these
};

/// A mesh of a GLB file.
struct GltfMesh {
    std::size_t place = 0;  ///< among the meshes of the file
    std::string name;       ///< may be empty
    /// Vertices are those of all primitives, one primitive after the other. Corners at identical positions have the
    /// first vertex there, as files cut a surface at its creases and old UVs; the others are in no face.
    PolygonMesh polygons;
    std::vector<GltfPrimitive> primitives;  ///< that have triangles, in the file's order, as their faces in `polygons`
};

/// Reads the triangles of a GLB file (glTF 2.0): lists, strips and fans. Lines and points are left out. Positions are
/// those of the mesh, without the nodes' transforms and without morph targets.
/// @return the meshes that have a triangle with three different vertices, at least one
/// @throws InputError the file is damaged, compressed, or has its data in other files; an index names a vertex that
/// does not exist (elements: faces); a coordinate is NaN or infinite (elements: vertices)
std::vector<GltfMesh> read_gltf_meshes(std::string_view glb);

/// Reads a set of UVs (TEXCOORD_N) of the same meshes: (C, 2) of the corners of each one's faces, v from the bottom up.
/// @throws InputError a primitive has no such set, or another number of UVs than of vertices
std::vector<PlanarPoints> read_gltf_uvs(std::string_view glb, int set);

/// Reads what parts the faces of the same meshes, as MeshFormat::corner_marks: materials of their primitives,
/// primitives (groups), and normals. A primitive without normals has one for all its corners.
/// @throws InputError a primitive has another number of normals than of vertices
std::vector<std::vector<Index>> read_gltf_marks(std::string_view glb, CutAt at);

/// Words that name a mesh: "mesh 2 (Head)".
std::string mesh_name(const GltfMesh& mesh);

}  // namespace koebe
