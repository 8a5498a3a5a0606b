// Joins edges to paths.
#pragma once

#include "core/types.h"

#include <utility>
#include <vector>

namespace koebe {

/// Paths of vertices that go along each edge once, as long as possible without a branch. A closed path ends with its
/// first vertex.
std::vector<std::vector<Index>> edge_chains(std::vector<std::pair<Index, Index>> edges);

}  // namespace koebe
