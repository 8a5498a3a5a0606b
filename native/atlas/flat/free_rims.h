// Lets rims at cuts follow the surface's edges.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Which vertices of a flat part may move.
struct RimFreedom {
    std::vector<Index> same;  ///< (V) vertices with the same number move alike; it is the number of the first of them
    std::vector<char> held;   ///< (V) 1 for vertices that stay
};

/// Lowers the angle error by freeing rims at cuts from their circles and lines. A cut is a zigzag of edges. On a circle
/// it bends the faces beside it. Minimizes sum |mu_f| + eps sum |d_v|^2 / h_v^2, with mu_f = f_zbar / f_z of a face's
/// linear map, d_v the way of a vertex, and h_v the length of its edges in the plane. The second sum keeps the course
/// of a rim, and lets only details of a few edges change. For the first sum alone every conformal map is a minimum. The
/// sums are minimized by reweighted least squares (Levy, Petitjean, Ray and Maillot 2002), with f_z of the last map. In
/// a large part only some rings beside the free rims move.
///
/// A step is taken if the mean angle error falls, and the numbers of flips and of crossings of loops do not rise.
/// @param vertices (V, 3) @param points (V, 2), moved in place
/// @throws Cancelled
void free_rims(const Vertices& vertices, const Surface& surface, const RimFreedom& freedom, PlanarPoints& points,
               ExecutionContext& context);

}  // namespace koebe
