// The shortest closed curves between two sets of faces: a minimum cut of the dual graph.
#pragma once

#include "evenness/part_mesh.h"

#include <vector>

namespace koebe {

enum class Side : signed char { outside = -1, free = 0, inside = 1 };

/// The labelling of least border between the faces inside and those outside (Boykov and Kolmogorov 2004): the capacity
/// of an edge is its length. Faces of one polygon go to one side together, and those round a loop too unless some of
/// them are given to either side. Then pieces of a few faces go to the side round them.
/// @param sides (F) @param factor (3F) on the lengths of edges, positive, of both half-edges alike; empty: 1
/// @return (F) 1 inside, 0 outside; empty if a side has no face
std::vector<int> minimum_cut(const PartMesh& part, const std::vector<Side>& sides, const VectorXd& factor = {});

}  // namespace koebe
