// Checks options that name boundary loops against the mesh.
#pragma once

#include "cli/files/mesh_input.h"
#include "mesh/topology.h"
#include "pipeline/options.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// The rank of the boundary loop that a vertex lies on.
/// @param option that names the vertex
/// @throws WrongUsage the vertex does not exist, or lies on no loop
Index loop_of(const Surface& surface, Index vertex, const std::string& option = "--outer");

/// Checks the vertices of --outer, --point and --center.
/// @throws WrongUsage the vertex does not exist, lies on no loop or, for --center, on a loop or in no face, or --point
/// lies on another loop than --outer; TopologyError as analyze_surface
void require_fitting_vertices(const MeshInput& input, const UniformizeOptions& options);

/// Checks the value of --loops.
/// @throws WrongUsage a rank that does not exist
void require_ranks(const std::vector<Index>& ranks, std::size_t loop_count);

}  // namespace koebe::cli
