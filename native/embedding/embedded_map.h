// The map that is always one to one, for surfaces where untangling a conformal map has failed.
#pragma once

#include "circles/circle_map.h"
#include "embedding/fixed_places.h"
#include "execution/execution.h"
#include "flaps/flaps.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Starts from a convex combination map of the surface with its holes filled, which is one to one for every surface
/// (convex_embedding). Lowers the angle error by steps that keep every face upright (filled_map.h): first alone, then
/// with the loops pulled harder and harder to their circles. At last the loop vertices are put on the circles and slide
/// there; a vertex stays off where a face would turn over. Loops that cannot be put on the wanted circles get other
/// circles that fit where they are. If vertices are still off, all loops get such circles. The attempt with the fewest
/// vertices off counts. As the holes' fans stay upright too, no loop crosses itself or another.
/// @param flaps of the surface: their rims are not pulled to the circles of inner loops
/// @param wanted the circles of the loops, apart from each other; empty: circles that fit the map before it is pulled
/// @param rim (n) points of the outer loop on the unit circle, in order, all different
/// @param places where vertices are to lie; if faces would turn over at 0, the centre lies nearby
CircleMap embedded_map(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<Flap>& flaps, const std::vector<Circle>& wanted, const VectorXcd& rim,
                       const ExecutionContext& context, FixedPlaces places = {});

/// Makes such a map without wanted circles for the inner loops, in a small part of the steps.
/// @return (V, 2), the outer loop on the unit circle, its steps at first in proportion to its edges
PlanarPoints freely_embedded(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                             const ExecutionContext& context);

}  // namespace koebe
