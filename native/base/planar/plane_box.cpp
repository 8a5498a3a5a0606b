#include "planar/plane_box.h"

#include <algorithm>

namespace koebe {

PlaneBox box_around(const std::vector<Complex>& points)
{
    PlaneBox box{points.front(), points.front()};
    for (const Complex z : points) {
        box.low = {std::min(box.low.real(), z.real()), std::min(box.low.imag(), z.imag())};
        box.high = {std::max(box.high.real(), z.real()), std::max(box.high.imag(), z.imag())};
    }
    return box;
}

}  // namespace koebe
