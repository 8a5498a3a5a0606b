// Short loops through the handles of a surface.
#pragma once

#include "cut/seamed_mesh.h"

#include "execution/execution.h"

#include <vector>

namespace koebe {

/// Loops that share no vertex and together separate nothing: each cut takes one handle away.
///
/// The shortest loop of the greedy homology bases of several base points, and those of the same bases that are not
/// much longer and keep clear of it. A basis: a tree of shortest paths from the base point; a tree of the dual graph
/// that crosses none of its edges and whose edges lie as far out as can be, each boundary loop one node; the edges left
/// over close the loops [Erickson and Whittlesey 2005, section 3].
/// @param mesh connected, of genus 1 at least @param base_points to try, 1 at least @param all any clear loop is taken
/// @return the half-edges of each loop, in its order
std::vector<std::vector<Index>> handle_loops(const SeamedMesh& mesh, int base_points, bool all,
                                             ExecutionContext& context);

}  // namespace koebe
