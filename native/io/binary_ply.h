// The usual binary PLY file, block by block.
#pragma once

#include "io/polygon_mesh.h"

#include <optional>
#include <string_view>

namespace koebe::io {

/// A little-endian file of vertices and then faces, whose one list is that of the corners. It is read on the calling
/// thread's share of threads.
/// @param header as read_ply hands it to CGAL @param data what follows it
/// @return nothing where the file is another one, or has a fault: CGAL then reads it, and its fault is told
std::optional<PolygonMesh> read_binary_ply(std::string_view header, std::string_view data);

}  // namespace koebe::io
