// Edges as paths.
#pragma once

#include "core/types.h"

#include <utility>
#include <vector>

namespace koebe {

/// Paths of vertices that go along each of the edges once, as long as they can be without a branch; a closed one has
/// its first vertex again at its end.
std::vector<std::vector<Index>> edge_chains(std::vector<std::pair<Index, Index>> edges);

}  // namespace koebe
