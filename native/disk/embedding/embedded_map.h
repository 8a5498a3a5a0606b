// The map that is always one to one, for surfaces where untangling a conformal map has failed.
#pragma once

#include "circles/circle_map.h"
#include "ears/ears.h"
#include "embedding/fixed_places.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <optional>
#include <vector>

namespace koebe {

/// Starts from a convex combination map of the surface with its holes filled, which is one to one for every surface
/// (convex_embedding). Lowers the angle error by steps that keep every face upright (filled_map.h): first without
/// pulls, then with the loops pulled harder and harder to their circles. At last the loop vertices are put on the
/// circles and slide along them. A vertex stays off its circle if a face would turn over. Loops that cannot be put on
/// the wanted circles get other circles that fit their present places. If vertices are still off their circles, all
/// loops get such circles. The attempt with the fewest vertices off their circles counts. As the holes' fans stay
/// upright too, no loop crosses itself or another loop.
/// @param ears of the surface: their rims are not pulled to the circles of inner loops
/// @param wanted the circles of the loops, apart from each other; empty: circles that fit the map before it is pulled
/// @param rim (n) points of the outer loop on the unit circle, in order, all different
/// @param places of vertices with fixed places; if faces would turn over with the centre at 0, it lies near 0
CircleMap embedded_map(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<Ear>& ears, const std::vector<Circle>& wanted, const VectorXcd& rim,
                       const ExecutionContext& context, FixedPlaces places = {});

/// Makes a map one to one that is wrong in few faces, and stays the same elsewhere: replaces the vertices around these
/// faces (mend_drawing), and pulls loop vertices back to their circles.
/// @param map of the surface, the circles apart
/// @return nothing if faces stay wrong
std::optional<CircleMap> mended_map(const Vertices& vertices, const Surface& surface,
                                    const std::vector<VertexLoop>& loops, const std::vector<Ear>& ears,
                                    const CircleMap& map, const ExecutionContext& context, FixedPlaces places = {});

/// Makes a map that is one to one, without wanted circles for the inner loops, in a small part of the steps.
/// @return (V, 2), the outer loop on the unit circle; at the start its steps are in proportion to its edges
PlanarPoints freely_embedded(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                             const ExecutionContext& context);

}  // namespace koebe
