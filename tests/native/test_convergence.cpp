// When the Koebe iteration ends: laws.
#include "iteration/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace koebe {

TEST(Convergence, circles_change_by_the_distance_of_their_centres_and_radii)
{
    CircleState before, after;
    before.circles = {{{0.0, 0.0}, 1.0}, {{0.1, 0.2}, 0.3}, {{-0.4, 0.1}, 0.2}};
    after = before;
    after.circles[1].center += Complex(0.03, 0.04);
    after.circles[2].radius -= 0.12;
    EXPECT_NEAR(circle_change(before, after), 0.13, 1e-15);
    EXPECT_FALSE(has_converged(before, after, 0.129));
    EXPECT_TRUE(has_converged(before, after, 0.131));
}

TEST(Convergence, rounds_that_come_no_nearer_are_a_standstill)
{
    std::vector<double> falling, rising;
    for (int round = 0; round < 12; ++round) {
        falling.push_back(std::pow(0.99, round));
        rising.push_back(std::pow(1.01, round));
        EXPECT_FALSE(is_at_standstill(falling));
        EXPECT_EQ(is_at_standstill(rising), round >= 10);
    }
}

}  // namespace koebe
