// Lifts a map of the plane to the sphere.
#pragma once

#include "execution/execution.h"
#include "sphere/plane_map.h"
#include "sphere/sphere_repair.h"
#include "sphere/spherical_balance.h"

namespace koebe {

/// Faces of a surface that may be drawn together, or opened at a vertex, at most.
inline constexpr Index most_drawn_faces = 5000;

/// Lifts a map to the sphere by stereographic projection, with loops on the circles of their caps, and flaps of the
/// outer loop in its cap. Balances it without flipping faces. A balanced surface of few faces may need faces of half
/// the sphere. It is drawn together round the middle of the outer circle's other side instead, where no such face is
/// needed.
/// @param balance of the map (balance_on_sphere) @param drawn out: whether it is drawn together
/// @throws Cancelled
SphericalMap lifted_sphere(const PeriodicSurface& domain, const PlaneMap& map, const PlaneSimilarity& balance,
                           bool& drawn, const ExecutionContext& context);

}  // namespace koebe
