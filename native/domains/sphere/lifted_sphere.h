// Maps onto the sphere: plane maps lifted to it, and coarse surfaces opened at a vertex.
#pragma once

#include "execution/execution.h"
#include "sphere/plane_map.h"
#include "sphere/sphere_repair.h"
#include "sphere/spherical_balance.h"
#include "surface/periodic_surface.h"

#include <optional>

namespace koebe {

/// Faces of a surface that may be drawn together, or opened at a vertex, at most.
inline constexpr Index most_drawn_faces = 5000;

/// Lifts a map to the sphere by stereographic projection, with loops on the circles of their caps, and ears of the
/// outer loop in its cap. Balances it without flipping faces. A balanced surface of few faces may need faces of half
/// the sphere. It is drawn together round the middle of the outer circle's other side instead, where no such face is
/// needed.
/// @param balance of the map (balance_on_sphere) @param drawn out: whether it is drawn together
/// @throws Cancelled
SphericalMap lifted_sphere(const PeriodicSurface& domain, const PlaneMap& map, const PlaneSimilarity& balance,
                           bool& drawn, const ExecutionContext& context);

/// For coarse surfaces where closed_sphere.h turns faces over. The faces round a vertex are removed. `uniformize` maps
/// the rest to the disk, one to one in 32-bit UVs. The vertex goes to the middle of the remaining cap. Tries some
/// vertices, those with the largest faces on the sphere, each balanced and drawn to half the sphere.
/// @param domain closed @param weights (V) area around each vertex @param points (V, 3) the map with flipped faces
/// @return a one-to-one map, or nothing
/// @throws Cancelled
std::optional<SphericalMap> opened_at_a_vertex(const PeriodicSurface& domain, const VectorXd& weights,
                                               const Vertices& points, ExecutionContext& context);

}  // namespace koebe
