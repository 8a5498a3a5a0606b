// Where the outer loop's vertices go for everything behind them to have room.
#pragma once

#include "embedding/convex_embedding.h"
#include "mesh/topology.h"

namespace koebe {

/// The rim with steps no smaller than a share of what they need, which is 1 / n of the circle each; and the arc behind
/// an edge that joins two vertices of the loop, t long, cuts off t^3 / 12 of the unit disk, so what lies behind it
/// needs at least the t at which its faces are as large as the others.
/// @param rim (n) points of the outer loop on the unit circle, in order; the first keeps its place
/// @param share 0: the rim as it is; 1: nothing is left of it
/// @param center a vertex, of no loop, that is to have the middle of the disk: what lies behind an edge is what
///        the edge parts from it; -1: from the largest part
VectorXcd roomy_rim(const FilledDisk& filled, const VertexLoop& outer, const VectorXcd& rim, double share,
                    Index center = -1);

}  // namespace koebe
