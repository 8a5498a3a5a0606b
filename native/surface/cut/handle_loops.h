// Finds short loops through the handles of a surface.
#pragma once

#include "cut/seamed_mesh.h"

#include "execution/execution.h"

#include <vector>

namespace koebe {

/// Finds loops that share no vertex and together do not separate the surface: each cut removes one handle.
///
/// Takes the shortest loop of the greedy homology bases of several base points, and other loops of these bases that are
/// not much longer and share no vertex with it. A basis has a tree of shortest paths from the base point, and a tree of
/// the dual graph that crosses none of its edges. The dual tree's edges lie as far out as possible; each boundary loop
/// is one node. The remaining edges close the loops [Erickson and Whittlesey 2005, section 3].
/// @param mesh connected, of genus at least 1 @param base_points to try, at least 1 @param all take long loops too
/// @return the half-edges of each loop in order
std::vector<std::vector<Index>> handle_loops(const SeamedMesh& mesh, int base_points, bool all,
                                             ExecutionContext& context);

}  // namespace koebe
