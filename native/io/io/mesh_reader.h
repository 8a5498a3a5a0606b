// Reads mesh files of the formats of mesh_formats.h, to polygons in 64 bits.
#pragma once

#include "core/api.h"
#include "io/polygon_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace koebe {

/// The bytes of a mesh file. They hold more than the mesh, and writers keep the rest.
struct MeshFile {
    std::string bytes;      ///< without a byte order mark
    std::string extension;  ///< in lower case, with the dot; empty: there is no file
};

/// @throws FileError, InputError as read_mesh; the bytes are not parsed
MeshFile read_mesh_file(const std::filesystem::path& path);

/// Reads a mesh file. The extension, in any case, gives the format.
///
/// OBJ; OFF, text only; PLY, text and binary of both byte orders; STL, text and binary: corners at identical positions
/// become one vertex, numbered by first appearance; GLB likewise, with one
/// mesh (gltf_meshes.h). Unused vertices stay, but for GLB. Numbers in text are read to the nearest
/// 64-bit float. Normals, colours, texture coordinates, groups and materials are ignored here, and kept by the writers
/// (mesh_writer.h).
///
/// @throws FileError the file cannot be read
/// @throws InputError the format is unknown or violated, or the file ends early (elements: the first vertex or face
/// that is not read); there is no vertex or no face; a face names a vertex that does not exist (elements: faces); a
/// coordinate is NaN or infinite (elements: vertices)
PolygonMesh read_mesh(const std::filesystem::path& path);

/// Reads a mesh from the bytes of a file.
/// @param extension of its name, with the dot
/// @throws InputError as read_mesh
KOEBE_API PolygonMesh parse_mesh(std::string_view bytes, const std::string& extension);

}  // namespace koebe
