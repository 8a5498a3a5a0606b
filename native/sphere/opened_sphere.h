// A closed surface on the sphere, one vertex opened.
#pragma once

#include "execution/execution.h"
#include "sphere/sphere_repair.h"

#include <optional>

namespace koebe {

/// For coarse surfaces whose map by closed_sphere.h turns faces over. The faces round a vertex are taken off,
/// uniformize maps the rest to the disk, one to one in 32-bit UVs, and the vertex goes to the middle of the cap that is
/// left. Some vertices are tried, those whose faces are largest on the sphere, each balanced and drawn to half the
/// sphere.
/// @param domain closed @param weights (V) area around each vertex @param points (V, 3) the map with flipped faces
/// @return a map that is one to one, or nothing
/// @throws Cancelled
std::optional<SphericalMap> opened_at_a_vertex(const PeriodicSurface& domain, const VectorXd& weights,
                                               const Vertices& points, ExecutionContext& context);

}  // namespace koebe
