#include "planar/planar_predicates.h"
#include "planar/star_centre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace koebe;

TEST(StarCentre, in_a_triangle_the_areas_are_in_proportion_to_the_weights)
{
    const std::vector<Complex> corners{{0.3, 0.1}, {1.2, 0.4}, {0.5, 2.0}};
    const double whole = cross(corners[1] - corners[0], corners[2] - corners[0]);
    for (const std::vector<double>& weights : std::vector<std::vector<double>>{{1, 1, 1}, {1, 5, 20}, {1, 1e4, 1}}) {
        const auto x = star_centre(corners, weights);
        ASSERT_TRUE(x);
        for (std::size_t i = 0; i < 3; ++i) {
            const double share = cross(corners[i] - *x, corners[(i + 1) % 3] - *x) / whole;
            EXPECT_NEAR(share * (weights[0] + weights[1] + weights[2]) / weights[i], 1.0, 1e-2);
        }
    }
}

TEST(StarCentre, a_fan_round_a_corner_has_room_for_a_vertex)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        // Round a corner at 0, over any angle below 360 degrees.
        const int n = 3 + i % 20;
        std::vector<double> angles;
        for (int k = 0; k < n; ++k) angles.push_back(6.2 * unit(random));
        std::sort(angles.begin(), angles.end());
        std::vector<Complex> polygon{0.0};
        for (const double angle : angles) polygon.push_back(std::polar(std::pow(10.0, -3.0 * unit(random)), angle));
        bool upright = true;
        for (int k = 1; k < n; ++k) upright = upright && cross(polygon[k], polygon[k + 1]) > 1e-9;
        if (!upright) continue;
        const auto x = star_centre(polygon, std::vector<double>(polygon.size(), 1.0));
        ASSERT_TRUE(x) << i;
        for (std::size_t k = 0; k < polygon.size(); ++k)
            EXPECT_GT(cross(polygon[k] - *x, polygon[(k + 1) % polygon.size()] - *x), 0.0) << i;
    }
}

TEST(StarCentre, a_polygon_without_a_kernel_has_none)
{
    // An S: its two ends do not see each other.
    const std::vector<Complex> polygon{{0, 0}, {3, 0}, {3, 2}, {1, 2}, {1, 3},   {3, 3},
                                       {3, 4}, {0, 4}, {0, 1}, {2, 1}, {2, 0.5}, {0, 0.5}};
    EXPECT_FALSE(star_centre(polygon, std::vector<double>(polygon.size(), 1.0)));
}
