// Draws edges in few long strokes, so that a picture's file is small.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

using Edge = std::array<Index, 2>;

/// Covers every edge once by walks over the graph, greedily, from vertices of odd degree first.
/// @param edges without duplicates and loops
std::vector<std::vector<Index>> edge_trails(const std::vector<Edge>& edges, Index vertex_count);

}  // namespace koebe
