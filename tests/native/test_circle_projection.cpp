#include "circles/circle_projection.h"

#include "circle_domain.h"

#include <gtest/gtest.h>

using namespace koebe;

using test::points_on;

TEST(CircleProjection, points_in_order_go_radially)
{
    const Circle circle{{0.3, -0.1}, 0.2};
    for (const int turn : {1, -1}) {
        VectorXcd points = points_on(circle, 40, 0.0, turn);
        const VectorXcd expected = points;
        for (Index i = 0; i < 40; ++i) points[i] += 0.05 * std::sin(3.0 * i) * (points[i] - circle.center);
        EXPECT_LT((project_onto_circle(circle, points, turn) - expected).cwiseAbs().maxCoeff(), 1e-15);
    }
}

TEST(CircleProjection, points_that_turn_back_are_put_in_order_and_the_others_stay)
{
    const Circle circle{{0.3, -0.1}, 0.2};
    for (const int turn : {1, -1})
        for (const Index place : {0, 17, 38}) {
            VectorXcd points = points_on(circle, 40, 0.0, turn);
            const VectorXcd even = points;
            std::swap(points[place], points[place + 1]);
            const VectorXcd result = project_onto_circle(circle, points, turn);
            for (Index i = 0; i < 40; ++i) {
                EXPECT_NEAR(std::abs(result[i] - circle.center), circle.radius, 1e-15);
                const double step =
                    turn * std::arg((result[(i + 1) % 40] - circle.center) / (result[i] - circle.center));
                EXPECT_GT(step, 1e-4) << place << " " << i;
                if (i != place && i != place + 1) {
                    EXPECT_LT(std::abs(result[i] - even[i]), 1e-15);
                }
            }
        }
}

TEST(CircleProjection, a_rim_that_turns_back_or_runs_round_twice_does_not_run_once_round)
{
    const Circle unit;
    for (const int turn : {1, -1}) {
        VectorXcd points = points_on(unit, 12, 0.0, turn);
        EXPECT_TRUE(run_once_round(points, turn));
        EXPECT_FALSE(run_once_round(points, -turn));
        // All on a part of the circle: the last step is more than half of it.
        for (Index i = 0; i < 12; ++i) points[i] = std::polar(1.0, turn * 0.2 * i);
        EXPECT_TRUE(run_once_round(points, turn));
        std::swap(points[4], points[5]);
        EXPECT_FALSE(run_once_round(points, turn));
        VectorXcd twice(24);
        twice << points_on(unit, 12, 0.0, turn), points_on(unit, 12, 0.0, turn);
        EXPECT_FALSE(run_once_round(twice, turn));
    }
}
