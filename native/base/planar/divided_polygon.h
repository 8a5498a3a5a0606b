// Cuts a polygon along segments inside it.
#pragma once

#include "core/types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace koebe {

/// Constrained Delaunay triangulation of a polygon that has the segments as edges. Predicates are exact (CGAL).
/// @param polygon simple, counter-clockwise; consecutive points may lie on a straight line
/// @param interior further points inside @param segments each by two points: the polygon's are numbered first
/// @return counter-clockwise triangles; empty if segments cross, points coincide, or a segment runs through a point
/// @param faulty if given, gets the numbers of segments that cross another one or a side, run through a point, or end
/// in one that coincides with another
Triangles divided_polygon(const std::vector<Complex>& polygon, const std::vector<Complex>& interior,
                          const std::vector<std::array<Index, 2>>& segments,
                          std::vector<std::size_t>* faulty = nullptr);

}  // namespace koebe
