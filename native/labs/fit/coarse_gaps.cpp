#include "fit/coarse_gaps.h"

#include "core/complex_places.h"

#include <cmath>
#include <cstddef>

namespace koebe {
namespace {

/// How far the rim's edge in a direction from the circle's centre leaves the circle.
double sagitta(const Circle& circle, const VertexLoop& loop, const PlanarPoints& uv, Complex direction)
{
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Complex a = complex_at(uv, loop[i]) - circle.center;
        const Complex b = complex_at(uv, loop[(i + 1) % loop.size()]) - circle.center;
        const double before = std::arg(direction / a), after = std::arg(b / direction);
        if (before * after >= 0.0 && std::abs(before + after - std::arg(b / a)) < 1e-9)
            return circle.radius * (1.0 - std::cos(0.5 * std::arg(b / a)));
    }
    return 0.0;
}

}  // namespace

std::optional<std::pair<Index, Index>> coarse_gap(const std::vector<Circle>& circles,
                                                  const std::vector<VertexLoop>& loops, const PlanarPoints& uv)
{
    for (std::size_t i = 0; i < circles.size(); ++i)
        for (std::size_t k = i + 1; k < circles.size(); ++k) {
            const Complex between = circles[k].center - circles[i].center;
            const double distance = std::abs(between);
            const Complex towards = distance > 0.0 ? between / distance : Complex(1.0);
            const double gap =
                i == 0 ? 1.0 - distance - circles[k].radius : distance - circles[i].radius - circles[k].radius;
            const double here = sagitta(circles[i], loops[i], uv, towards);
            const double there = sagitta(circles[k], loops[k], uv, i == 0 ? towards : -towards);
            // Edges make holes smaller, and the disk too: there both rims leave their circles to the same side.
            const double left = i == 0 ? std::abs(there - here) : here + there;
            if (left > gap) return std::pair{static_cast<Index>(i), static_cast<Index>(k)};
        }
    return {};
}

}  // namespace koebe
