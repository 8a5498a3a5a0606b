// The edges along a boundary loop.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// (n) length of the edge from each vertex of a loop to the next. An edge counts as at least 1e-9 of the mean, as
/// vertices that coincide in space still need an angle of their own. So all lengths are positive.
KOEBE_API VectorXd loop_edges(const Vertices& vertices, const VertexLoop& loop);

}  // namespace koebe
