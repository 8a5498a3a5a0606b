// PLY files, as text: the polygons as they were filed, with texture coordinates or the numbers of patches, and what
// else the file held.
#pragma once

#include "io/atomic_file.h"
#include "io/file_losses.h"
#include "io/polygon_mesh.h"

#include <string_view>
#include <vector>

namespace koebe {

/// The bytes of a PLY file that a mesh was read from, or none. Its comments, its other elements and the other
/// properties of vertices and faces are written again, as text; only texture coordinates are replaced.
struct FiledPly {
    std::string_view bytes = {};
    bool moved = false;  ///< the mesh has the vertices elsewhere: normals are left out
};

/// Writes the mesh with u = (1 + x) / 2, v = (1 + y) / 2 of each vertex, clamped to [0, 1], under both pairs of names
/// that programs look for: s and t (Blender), texture_u and texture_v (MeshLab, VTK). All numbers are the shortest
/// that read back to the same 64-bit float. As text, since binary files of polygons with different numbers of corners
/// are refused by readers in use (trimesh, meshio). The caller commits the file.
/// @param disk_points (V, 2) points of the closed unit disk
/// @throws InputError disk_points has not one row for each vertex
/// @throws FileError
io::FileLosses write_ply_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points,
                                  const FiledPly& filed = {});

/// Writes the mesh with the list property `texcoord` of each face: u and v of its corners, as MeshLab has it.
/// @param corner_uvs (C, 2) in [0, 1]^2, in the order of mesh.corners
/// @throws InputError corner_uvs has not one row for each corner
/// @throws FileError
io::FileLosses write_ply_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs,
                                         const FiledPly& filed = {});

/// Writes the mesh with the property `patch` for each face. The caller commits the file.
/// @param patch (F) number of each face's patch, -1 for none
/// @throws FileError
void write_ply_with_patches(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch);

}  // namespace koebe
