// Gaps between loops that are too narrow for the edges of the rims.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <optional>
#include <utility>
#include <vector>

namespace koebe {

/// Two loops in whose gap the mesh is not the circle domain: where they are nearest, the edges of both rims leave their
/// circles by more than the gap is wide.
/// @param circles of the rims, the unit circle first @param loops rims, all vertices @param uv (V, 2)
/// @return the first such pair
std::optional<std::pair<Index, Index>> coarse_gap(const std::vector<Circle>& circles,
                                                  const std::vector<VertexLoop>& loops, const PlanarPoints& uv);

}  // namespace koebe
