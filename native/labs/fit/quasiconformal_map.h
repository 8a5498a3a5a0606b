// The quasiconformal map of a circle domain with given Beltrami coefficients.
#pragma once

#include "circles/circle.h"
#include "core/types.h"
#include "execution/execution.h"

#include <optional>
#include <vector>

namespace koebe {

/// The map to a circle domain with f_conj(z) = mu f_z: the conformal map of the metric |dz + mu d conj(z)|, by Koebe's
/// iteration. An automorphism takes its circles nearest to the goal's. Then its rims are put on the goal, and the
/// inside follows harmonically. So the map has these mu if the goal is their domain, and else nearly.
/// @param uv (V, 2) @param loops rims, the outer one first, the domain on their left @param mu (F), |mu| < 1
/// @param goal the unit circle first
/// @return (V, 2); nothing if the metric is too uneven for the triangles @throws SolverError, Cancelled
std::optional<PlanarPoints> quasiconformal_map(const Triangles& triangles, const PlanarPoints& uv,
                                               const std::vector<VertexLoop>& loops, const VectorXcd& mu,
                                               const std::vector<Circle>& goal, ExecutionContext& context);

}  // namespace koebe
