// Rims at cuts, which follow the surface's edges.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Which vertices of a flat part may move.
struct RimFreedom {
    std::vector<Index> same;  ///< (V) vertices with one number move alike, which is that of the first of them
    std::vector<char> held;   ///< (V) 1 for vertices that stay
};

/// Makes the angle error less, rims at cuts free of their circles and lines. A cut runs in a zigzag along edges; put on
/// a circle it bends the faces beside it. Minimizes sum |mu_f| + eps sum |d_v|^2 / h_v^2, mu_f = f_zbar / f_z of a
/// face's linear map, d_v the way of a vertex, h_v its edges' length in the plane: any conformal map would do for the
/// first sum, by the second a rim keeps its course, and only what few edges span changes. By least squares (as Levy,
/// Petitjean, Ray and Maillot 2002), f_z taken from the map before, reweighted. Of a large part only some rings beside
/// the rims that are free move.
///
/// A step is taken if the mean angle error falls, no more faces are turned over and no more loop edges cross.
/// @param vertices (V, 3) @param points (V, 2), moved in place
/// @throws Cancelled
void free_rims(const Vertices& vertices, const Surface& surface, const RimFreedom& freedom, PlanarPoints& points,
               ExecutionContext& context);

}  // namespace koebe
