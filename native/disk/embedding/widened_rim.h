// Spaces the outer loop's vertices so that the faces behind each edge have room.
#pragma once

#include "embedding/convex_embedding.h"
#include "mesh/topology.h"

namespace koebe {

/// Widens the rim's steps to a share of the room that they need. Each step needs 1 / n of the circle. Behind an edge
/// that joins two vertices of the loop, an arc of length t cuts off t^3 / 12 of the unit disk. So the arc needs at
/// least the t at which the faces behind the edge are as large as the other faces.
/// @param rim (n) points of the outer loop on the unit circle, in order; the first keeps its place
/// @param share 0: the rim does not change; 1: only the needs count
/// @param center an inner vertex for the middle of the disk, which is not behind any edge; -1: the largest part is not
VectorXcd widened_rim(const FilledDisk& filled, const VertexLoop& outer, const VectorXcd& rim, double share,
                      Index center = -1);

}  // namespace koebe
