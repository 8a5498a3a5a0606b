// Options that name boundary loops, against the mesh.
#pragma once

#include "cli/files/mesh_input.h"
#include "mesh/topology.h"
#include "pipeline/options.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// The rank of the boundary loop that a vertex lies on.
/// @param option that names the vertex
/// @throws WrongUsage there is no such vertex, or it lies on none
Index loop_of(const Surface& surface, Index vertex, const std::string& option = "--outer");

/// For the vertices that --outer, --point and --center name.
/// @throws WrongUsage there is no such vertex, it lies on no loop or, for --center, on one or in no face, or --point
///         lies on another loop than --outer; TopologyError as analyze_surface
void require_fitting_vertices(const MeshInput& input, const UniformizeOptions& options);

/// For the value of --loops.
/// @throws WrongUsage a rank that there is not
void require_ranks(const std::vector<Index>& ranks, std::size_t loop_count);

}  // namespace koebe::cli
