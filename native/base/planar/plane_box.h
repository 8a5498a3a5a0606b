// Boxes in the plane.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// A rectangle in the plane.
struct PlaneBox {
    Complex low, high;
    Complex size() const { return high - low; }
    Complex middle() const { return 0.5 * low + 0.5 * high; }
};

/// The least box. @param points one at least
PlaneBox box_around(const std::vector<Complex>& points);

}  // namespace koebe
