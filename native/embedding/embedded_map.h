// The map that is always one to one: where untangling a conformal map has failed.
#pragma once

#include "circles/circle_map.h"
#include "embedding/fixed_places.h"
#include "execution/execution.h"
#include "flaps/flaps.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Starts from a convex combination map of the surface with its holes filled, which is one to one whatever the surface
/// (convex_embedding), and lowers the angle error by steps that keep every face upright (filled_map.h): first alone,
/// then with the loops pulled to their circles, harder and harder, on which they are put at last and slide. Where this
/// would turn a face over a vertex stays off. So loops that cannot be put on the wanted circles get others, which fit
/// where they are; and if vertices are off then too, all loops get such; what has the fewest off is taken. As the
/// holes' fans stay upright too, no loop crosses itself or another.
/// @param flaps of the surface: their rims are not pulled to the circles of inner loops
/// @param wanted the circles of the loops, apart from each other; empty: such as fit the map before it is pulled
/// @param rim (n) points of the outer loop on the unit circle, in order, all different
/// @param places where vertices are to lie; where faces would turn over by that, the centre lies nearby
CircleMap embedded_map(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<Flap>& flaps, const std::vector<Circle>& wanted, const VectorXcd& rim,
                       const ExecutionContext& context, FixedPlaces places = {});

/// Likewise, with no circle wanted for the inner loops: in a small part of the steps.
/// @return (V, 2), the outer loop on the unit circle, its steps in proportion to its edges at first
PlanarPoints freely_embedded(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                             const ExecutionContext& context);

}  // namespace koebe
