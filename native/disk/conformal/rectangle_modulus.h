// The modulus of a quadrilateral.
#pragma once

#include "core/types.h"

#include <array>

namespace koebe {

/// Side 0-1 over side 1-2 of the rectangle to which a conformal map takes the unit disk, and these points of its rim to
/// the corners. It is a ratio of complete elliptic integrals, computed by arithmetic-geometric means of the
/// cross-ratio.
/// @param corners on the unit circle, counter-clockwise, no two equal
double rectangle_modulus(const std::array<Complex, 4>& corners);

}  // namespace koebe
