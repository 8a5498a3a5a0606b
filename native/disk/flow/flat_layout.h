// Lays a flat metric into the plane.
#pragma once

#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// (3F) each half-edge as a vector of the plane, with the faces unfolded over a tree of the dual graph. The first edge
/// of the first face lies along the real axis. Where the metric is flat and loops turn by multiples of 2 pi, the two
/// half-edges of every edge are opposite.
VectorXcd unfolded_edges(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<Index>& twin);

/// (V) positions whose differences are nearest to the edges in weighted least squares, sum |dz - e|^2 / l. Exact where
/// the edges close up round every hole; otherwise the gap is shared evenly. 0 at unused vertices.
/// @throws SolverError
VectorXcd positions_from_edges(const Triangles& triangles, const EdgeLengths& lengths, const VectorXcd& edges,
                               Index vertex_count);

/// (V) positions along a tree of edges from the first vertex of the first face, at 0; correct up to the holes' periods.
VectorXcd positions_along_tree(const Triangles& triangles, const VectorXcd& edges, Index vertex_count);

}  // namespace koebe
