// What a map to the sphere promises: laws of the check.
#include "sphere/sphere_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace koebe {

TEST(SphereCheck, a_loop_that_crosses_itself_is_not_simple_round_its_hole)
{
    constexpr int n = 12;
    constexpr double radius = 0.5;
    Vertices points(n, 3);
    for (int k = 0; k < n; ++k) {  // clockwise round its hole, seen from outside
        const double angle = -2.0 * std::numbers::pi * k / n;
        points.row(k) << std::sin(radius) * std::cos(angle), std::sin(radius) * std::sin(angle), std::cos(radius);
    }
    VertexLoop loop(n);
    std::iota(loop.begin(), loop.end(), 0);
    const std::vector<Cap> caps{{{0.0, 0.0, 1.0}, radius}};
    EXPECT_TRUE(find_sphere_faults(Triangles(0, 3), {loop}, points, caps).holes.empty());
    std::swap(loop[3], loop[4]);
    EXPECT_EQ(find_sphere_faults(Triangles(0, 3), {loop}, points, caps).holes, std::vector<int>{0});
}

}  // namespace koebe
