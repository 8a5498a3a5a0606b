// The arrays that the page draws: triangles of a mesh file, with texture coordinates of their corners.
#pragma once

#include "io/polygon_mesh.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace koebe::web {

struct DrawnMesh {
    std::vector<float> positions;  ///< (V, 3)
    std::vector<Index> corners;    ///< (T, 3) vertices
    std::vector<Index> faces;      ///< (T) of the file
    std::vector<float> uvs;        ///< (T, 3, 2) of the corners; empty if the file has none
};

/// Reads a mesh file. Polygons are cut into triangles as before a map; those that cannot be cut are left out.
/// @throws FileError, InputError as read_mesh
DrawnMesh read_drawn_mesh(const std::filesystem::path& path);

/// Texture coordinates of the corners of an OBJ file that the command has written.
/// @param bytes of the file @param corner_count of its faces
/// @return (C, 2) in the order of the corners, or empty: some corner has none
std::vector<float> written_uvs(std::string_view bytes, std::size_t corner_count);

}  // namespace koebe::web
