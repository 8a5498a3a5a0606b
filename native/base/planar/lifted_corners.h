// The corners of a face of a planar map. In a periodic map they are brought side by side.
#pragma once

#include "core/types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace koebe {

/// (F) numbers of periods to add to the places of a face's corners.
using CornerLifts = std::vector<std::array<std::array<int, 2>, 3>>;

using CornerPlaces = std::array<Complex, 3>;

inline CornerPlaces corners_of(const PlanarPoints& points, const Triangles& triangles, Eigen::Index f)
{
    CornerPlaces corners;
    for (int k = 0; k < 3; ++k) corners[k] = {points(triangles(f, k), 0), points(triangles(f, k), 1)};
    return corners;
}

/// @param lifts not read without periods
inline CornerPlaces corners_of(const PlanarPoints& points, const Triangles& triangles, const CornerLifts& lifts,
                               const std::vector<Complex>& periods, Eigen::Index f)
{
    CornerPlaces corners = corners_of(points, triangles, f);
    for (std::size_t j = 0; j < periods.size(); ++j)
        for (int k = 0; k < 3; ++k) corners[k] += static_cast<double>(lifts[f][k][j]) * periods[j];
    return corners;
}

}  // namespace koebe
