// The edges along a boundary loop.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// (n) length of the edge from each vertex of a loop to the next. Vertices that coincide in space still need an angle
/// of their own, so no edge counts for less than 1e-9 of the mean, and all are positive.
KOEBE_API VectorXd loop_edges(const Vertices& vertices, const VertexLoop& loop);

}  // namespace koebe
