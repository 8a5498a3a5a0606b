// The shortest closed curves between two sets of faces: a minimum cut of the dual graph.
#pragma once

#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

enum class Side : signed char { outside = -1, free = 0, inside = 1 };

/// Labels the free faces so that the border between inside and outside is shortest (Boykov and Kolmogorov 2004). The
/// capacity of an edge is its length. All faces of a polygon get the same side. All faces round a loop do too, unless
/// `sides` has both sides there. Then pieces of a few faces take the side round them.
/// @param sides (F) @param factor (3F) positive factors on the lengths of edges, the same on both half-edges; empty: 1
/// @return (F) 1 inside, 0 outside; empty if a side has no face
std::vector<int> minimum_cut(const PartMesh& part, const std::vector<Side>& sides, const VectorXd& factor = {});

}  // namespace koebe
