// Mesh files: OBJ, OFF, PLY and STL to polygons in 64 bits.
#pragma once

#include "core/api.h"
#include "io/polygon_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace koebe {

/// The bytes of a mesh file, which hold more than the mesh: what is written keeps the rest of it.
struct MeshFile {
    std::string bytes;      ///< without a byte order mark
    std::string extension;  ///< in lower case, with the dot; empty: no file
};

/// @throws FileError, InputError as read_mesh; the bytes are not looked at
MeshFile read_mesh_file(const std::filesystem::path& path);

/// Reads a mesh file; the extension, in any case, names the format.
///
/// OBJ; OFF, text only; PLY, text and binary of both byte orders; STL, text and binary, with corners of identical
/// position made one vertex, numbered by first appearance. Vertices of no face stay. Numbers of a text are read to the
/// nearest 64-bit float. Normals, colours, texture coordinates, groups and materials are passed over
/// here, and kept by the writers (mesh_writer.h).
///
/// @throws FileError the file cannot be read
/// @throws InputError the format is not supported; it is not followed, or the file ends early (elements: the first
///         vertex or face that is not read); there is no vertex or no face; a face names a vertex that is not there
///         (elements: faces); a coordinate is NaN or infinite (elements: vertices)
PolygonMesh read_mesh(const std::filesystem::path& path);

/// The same for the bytes of a file.
/// @param extension of its name, with the dot
/// @throws InputError as read_mesh
KOEBE_API PolygonMesh parse_mesh(std::string_view bytes, const std::string& extension);

}  // namespace koebe
