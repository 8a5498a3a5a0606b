// Circle domains as lists of circles, and Moebius images of them.
#pragma once

#include "circles/moebius.h"

#include <random>
#include <vector>

namespace koebe::test {

inline std::vector<Circle> image(const Moebius& map, std::vector<Circle> circles)
{
    for (std::size_t k = 1; k < circles.size(); ++k) circles[k] = map(circles[k]);
    return circles;
}

inline std::vector<Circle> reordered(const std::vector<Circle>& circles, const std::vector<int>& order)
{
    std::vector<Circle> result;
    for (const int k : order) result.push_back(circles[k]);
    return result;
}

inline std::vector<Circle> mirrored(std::vector<Circle> circles)
{
    for (Circle& circle : circles) circle.center = std::conj(circle.center);
    return circles;
}

/// So many holes with random centres and radii, apart from each other.
inline std::vector<Circle> random_domain(int holes, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1.0, 1.0), size(0.3, 1.0);
    const double largest = 0.5 / std::sqrt(holes + 1.0);
    std::vector<Circle> circles{Circle{}};
    while (static_cast<int>(circles.size()) <= holes) {
        const Circle next{{place(random), place(random)}, largest * size(random)};
        bool free = std::abs(next.center) + next.radius < 0.97;
        for (std::size_t k = 1; k < circles.size(); ++k)
            free = free && std::abs(circles[k].center - next.center) > 1.05 * (circles[k].radius + next.radius);
        if (free) circles.push_back(next);
    }
    return circles;
}

inline const Moebius some_maps[] = {
    {{0.0, 0.0}, std::polar(1.0, 1.0)}, {{0.3, -0.5}, {1.0, 0.0}}, {{-0.6, 0.5}, std::polar(1.0, -2.0)}};

}  // namespace koebe::test
