// A circle of the plane.
#pragma once

#include "core/types.h"

namespace koebe {

struct Circle {
    Complex center{0.0, 0.0};
    double radius = 1.0;
};

}  // namespace koebe
