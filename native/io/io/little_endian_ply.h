// Reads the usual binary PLY file, little-endian, block by block.
#pragma once

#include "io/ply_file.h"
#include "io/polygon_mesh.h"

#include <optional>

namespace koebe::io {

/// Reads a little-endian file that has vertices first and then faces. The list of corners must be the only list of a
/// face. Uses the calling thread's share of threads.
/// @return nothing for another kind of file, or with a fault: the file is then read value by value, which reports it
std::optional<PolygonMesh> read_little_endian_ply(const PlyFile& file);

}  // namespace koebe::io
