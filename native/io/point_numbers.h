// Vertices told by their positions, of files that have a vertex several times.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace koebe::io {

/// A point in an order where -0 is 0 and a NaN equals no number.
struct Point : std::array<double, 3> {
    static std::pair<int, double> rank(double number)
    {
        if (!std::isnan(number)) return {0, number};
        return {std::signbit(number) ? -1 : 1, 0.0};
    }
    friend bool operator<(const Point& a, const Point& b)
    {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                            [](double x, double y) { return rank(x) < rank(y); });
    }
};

/// The vertex at each position.
using PointNumbers = std::map<Point, Index>;

}  // namespace koebe::io
