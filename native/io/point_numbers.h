// Vertices told by their positions, of files that have a vertex several times.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <array>
#include <compare>
#include <map>

namespace koebe::io {

/// A point in an order where -0 is 0 and a NaN equals no number.
struct Point : std::array<double, 3> {
    friend bool operator<(const Point& a, const Point& b)
    {
        return std::is_lt(
            std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end(), std::weak_order));
    }
};

/// The vertex at each position.
using PointNumbers = std::map<Point, Index>;

}  // namespace koebe::io
