// Cuts a polygon along segments inside it.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

/// Constrained Delaunay triangulation of a polygon that has the segments as edges. Predicates are exact (CGAL).
/// @param polygon simple, counter-clockwise; consecutive points may lie on a straight line
/// @param interior further points inside @param segments each by two points: the polygon's are numbered first
/// @return counter-clockwise triangles; empty if segments cross, points coincide, or a segment runs through a point
Triangles divided_polygon(const std::vector<Complex>& polygon, const std::vector<Complex>& interior,
                          const std::vector<std::array<Index, 2>>& segments);

}  // namespace koebe
