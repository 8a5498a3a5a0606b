#include "circles/off_circle.h"

#include "core/counted.h"
#include "core/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {

bool is_off_circle(const Circle& circle, Complex point)
{
    return !(std::abs(std::abs(point - circle.center) - circle.radius) <= circle_tolerance);
}

void warn_off_circle(std::vector<Index> vertices, std::vector<Warning>& warnings)
{
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (vertices.empty()) return;
    std::string sentence =
        counted(vertices.size(), "vertex") + " taken off the circle, where straight triangles cannot follow it";
    warnings.push_back({WarningKind::off_circle, std::move(sentence), std::move(vertices)});
}

}  // namespace koebe
