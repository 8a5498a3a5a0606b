// Mesh files: OBJ, OFF, PLY and STL to polygons in 64 bits.
#pragma once

#include "core/api.h"
#include "io/polygon_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace koebe {

/// Reads a mesh file; the extension, in any case, names the format.
///
/// OBJ; OFF, text only; PLY, text and binary of both byte orders; STL, text and binary, with corners of identical
/// position made one vertex, numbered by first appearance. Vertices of no face stay. Numbers of a text are read to the
/// nearest 64-bit float. Normals, colours, texture coordinates, groups and materials are passed over.
///
/// The parsers are CGAL's. OpenMesh's keep 32-bit positions, and leave a vertex that is not a number out, which
/// renumbers all that follow.
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
