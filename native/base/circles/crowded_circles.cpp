#include "circles/crowded_circles.h"

#include <algorithm>
#include <cmath>

namespace koebe {

bool is_apart(const std::vector<Circle>& circles, std::size_t k, double margin)
{
    const double radius = margin * circles[k].radius;
    if (!(radius > 0.0) || !(std::abs(circles[k].center) + radius < 1.0)) return false;
    for (std::size_t j = 1; j < circles.size(); ++j)
        if (j != k && !(std::abs(circles[k].center - circles[j].center) > radius + circles[j].radius)) return false;
    return true;
}

bool circles_apart(const std::vector<Circle>& circles)
{
    for (std::size_t k = 1; k < circles.size(); ++k)
        if (!is_apart(circles, k)) return false;
    return true;
}

std::vector<Index> shrink_crowded(std::vector<Circle>& circles)
{
    constexpr double share = 0.9;  // of the room of a circle
    const std::vector<Circle> before = circles;
    std::vector<Index> changed;
    for (std::size_t k = 1; k < circles.size(); ++k) {
        double room = 1.0 - std::abs(before[k].center);
        for (std::size_t j = 1; j < circles.size(); ++j)
            if (j != k)
                room = std::min(room, std::abs(before[k].center - before[j].center) * before[k].radius /
                                          (before[k].radius + before[j].radius));
        if (before[k].radius <= room) continue;
        circles[k].radius = share * room;
        changed.push_back(static_cast<Index>(k));
    }
    return changed;
}

}  // namespace koebe
