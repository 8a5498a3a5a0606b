// Whether two lists of circles are the same.
#pragma once

#include "circles/circle.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace koebe {

/// @param a, b circles that correspond by number @param tolerance disk units: differences as small are rounding
inline bool same_circles(const std::vector<Circle>& a, const std::vector<Circle>& b, double tolerance = 1e-9)
{
    for (std::size_t k = 0; k < a.size(); ++k)
        if (std::abs(a[k].center - b[k].center) + std::abs(a[k].radius - b[k].radius) > tolerance) return false;
    return true;
}

}  // namespace koebe
