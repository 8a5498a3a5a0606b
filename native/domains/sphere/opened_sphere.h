// Maps a closed surface to the sphere by opening one vertex.
#pragma once

#include "execution/execution.h"
#include "sphere/sphere_repair.h"

#include <optional>

namespace koebe {

/// For coarse surfaces where closed_sphere.h turns faces over. The faces round a vertex are removed. `uniformize` maps
/// the rest to the disk, one to one in 32-bit UVs. The vertex goes to the middle of the remaining cap. Tries some
/// vertices, those with the largest faces on the sphere, each balanced and drawn to half the sphere.
/// @param domain closed @param weights (V) area around each vertex @param points (V, 3) the map with flipped faces
/// @return a one-to-one map, or nothing
/// @throws Cancelled
std::optional<SphericalMap> opened_at_a_vertex(const PeriodicSurface& domain, const VectorXd& weights,
                                               const Vertices& points, ExecutionContext& context);

}  // namespace koebe
