// Whether points lie on circles.
#pragma once

#include "circles/circle.h"

namespace koebe {

/// Whether a point is as near to a circle as this share of its radius, or as coordinates are rounded.
bool is_on_circle(const Circle& circle, Complex point, double tolerance);

}  // namespace koebe
