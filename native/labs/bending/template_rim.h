// How the rim of a hole lies on the circle that it is bent to.
#pragma once

#include "core/types.h"

#include <optional>

namespace koebe {

/// A vertex of a rim, and its place on the circle.
struct RimPin {
    Index vertex = -1;   ///< of the input
    double angle = 0.0;  ///< radians, counter-clockwise from the direction of x, seen from the circle's centre
};

/// How a rim lies on its circle.
struct TemplateRim {
    bool rotates = true;  ///< vertices slide along the circle. False: they keep their angles in the conformal domain
    std::optional<RimPin> pin = {};  ///< this vertex goes to this place, and the others slide
};

}  // namespace koebe
