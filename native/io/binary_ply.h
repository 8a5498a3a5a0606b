// The usual binary PLY file, block by block.
#pragma once

#include "io/ply_file.h"
#include "io/polygon_mesh.h"

#include <optional>

namespace koebe::io {

/// A little-endian file of vertices and then faces, whose one list is that of the corners. It is read on the calling
/// thread's share of threads.
/// @return nothing where the file is another one, or has a fault: it is then read value by value, and its fault is told
std::optional<PolygonMesh> read_binary_ply(const PlyFile& file);

}  // namespace koebe::io
