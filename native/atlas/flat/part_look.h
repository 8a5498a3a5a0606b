// What a flat part looks like: how large it is, how long its outline, and how much of it wastes texels.
#pragma once

#include "flat/flat_part.h"

#include <cmath>
#include <numbers>

namespace koebe {

struct PartLook {
    double area = 0.0, length = 0.0;  ///< in the plane, and of all loops
    double wasted = 0.0;              ///< area of faces whose texels are much too dense

    /// The area, less the less it is like a disk: 4 pi A^2 / L^2.
    double compact_area() const { return 4.0 * std::numbers::pi * std::pow(area / length, 2); }
};

PartLook look_of(const FlatPart& flat);

}  // namespace koebe
