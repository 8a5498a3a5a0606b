// Options that name boundary loops, against the mesh.
#pragma once

#include "cli/mesh_input.h"
#include "core/topology.h"

#include <optional>
#include <vector>

namespace koebe::cli {

/// The rank of the boundary loop that a vertex lies on.
/// @throws WrongUsage there is no such vertex, or it lies on none
Index loop_of(const Surface& surface, Index vertex);

/// For the value of --outer.
/// @throws WrongUsage as loop_of; TopologyError as analyze_surface
void require_on_a_loop(const MeshInput& input, Index vertex);

/// For the value of --loops.
/// @throws WrongUsage a rank that there is not
void require_ranks(const std::vector<Index>& ranks, std::size_t loop_count);

}  // namespace koebe::cli
