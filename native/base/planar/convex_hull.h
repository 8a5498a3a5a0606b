// The convex hull of points in the plane.
#pragma once

#include "core/numbering.h"
#include "core/types.h"

#include <algorithm>
#include <array>
#include <vector>

namespace koebe {

/// Indices of the corners of the convex hull, counter-clockwise (Andrew 1979). @param points (V, 2)
inline std::vector<Eigen::Index> convex_hull(const PlanarPoints& points)
{
    const auto turns_left = [&](Eigen::Index a, Eigen::Index b, Eigen::Index c) {
        const Eigen::RowVector2d along = points.row(b) - points.row(a), on = points.row(c) - points.row(b);
        return along[0] * on[1] - along[1] * on[0] > 0.0;
    };
    std::vector<Eigen::Index> order = numbers_below<Eigen::Index>(points.rows());
    std::ranges::sort(order, {}, [&](Eigen::Index i) { return std::array{points(i, 0), points(i, 1)}; });
    std::vector<Eigen::Index> corners;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = corners.size();
        for (const Eigen::Index i : order) {
            while (corners.size() >= first + 2 && !turns_left(corners[corners.size() - 2], corners.back(), i))
                corners.pop_back();
            corners.push_back(i);
        }
        corners.pop_back();
        std::ranges::reverse(order);
    }
    return corners;
}

}  // namespace koebe
