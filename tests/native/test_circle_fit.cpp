#include "circles/circle_fit.h"
#include "circles/moebius.h"

#include "circle_domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;

namespace {

using std::numbers::pi;
using test::points_on;

void expect_equal(const Circle& found, const Circle& expected, double tolerance)
{
    EXPECT_LT(std::abs(found.center - expected.center), tolerance * expected.radius);
    EXPECT_NEAR(found.radius, expected.radius, tolerance * expected.radius);
}

}  // namespace

TEST(CircleFit, least_squares_finds_a_circle_from_uneven_points_at_any_scale)
{
    for (const double scale : {1e-8, 1.0, 1e8}) {
        const Circle circle{scale * Complex(3.0, -2.0), 0.5 * scale};
        for (const double skew : {0.0, 0.5, 0.9})
            expect_equal(fit_circle_least_squares(points_on(circle, 17, skew)), circle, 1e-13);
        // Half of the circle is enough.
        expect_equal(fit_circle_least_squares(points_on(circle, 40).head(20)), circle, 1e-12);
    }
}

TEST(CircleFit, least_squares_makes_the_distances_stationary)
{
    VectorXcd points = points_on({{1.0, 2.0}, 2.0}, 31, 0.4);
    for (int i = 0; i < points.size(); ++i) points[i] += 0.1 * std::polar(1.0, 7.0 * i * i);
    const auto sum = [&](const Circle& c) { return ((points.array() - c.center).abs() - c.radius).square().sum(); };
    const Circle best = fit_circle_least_squares(points);
    for (const double e : {1e-3, -1e-3}) {
        EXPECT_LT(sum(best), sum({best.center + e, best.radius}));
        EXPECT_LT(sum(best), sum({best.center + Complex(0.0, e), best.radius}));
        EXPECT_LT(sum(best), sum({best.center, best.radius + e}));
    }
}

TEST(CircleFit, the_papers_circle_is_exact_for_even_points_and_second_order_for_uneven_ones)
{
    const Circle circle{{-1.0, 0.5}, 0.3};
    expect_equal(fit_circle_paper(points_on(circle, 23)), circle, 1e-14);
    const double coarse = std::abs(fit_circle_paper(points_on(circle, 40, 0.5)).center - circle.center);
    const double fine = std::abs(fit_circle_paper(points_on(circle, 80, 0.5)).center - circle.center);
    EXPECT_GT(coarse, 1e-5);
    EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

TEST(CircleFit, length_weights_sum_to_one_and_follow_the_edges)
{
    VectorXcd square(5);  // one side has a point in its middle
    square << Complex(0, 0), Complex(1, 0), Complex(2, 0), Complex(2, 2), Complex(0, 2);
    const VectorXd weights = length_weights(square);
    EXPECT_NEAR(weights.sum(), 1.0, 1e-15);
    EXPECT_NEAR(weights[1], 0.125, 1e-15);  // two edges of 1, half of 2, of 8
    EXPECT_NEAR(weights[3], 0.25, 1e-15);
    EXPECT_LT(std::abs(fit_circle_paper(square).center - Complex(1.0, 1.0)), 1e-15);
}

TEST(CircleFit, roundness_is_the_one_in_print)
{
    // Radii in turn 1 + e and 1 - e: the centre is 0 by symmetry, R = 1, and every deviation is e.
    const double e = 1e-2;
    VectorXcd star(40);
    for (int i = 0; i < 40; ++i) star[i] = std::polar(i % 2 == 0 ? 1.0 + e : 1.0 - e, 2.0 * pi * i / 40);
    EXPECT_NEAR(paper_roundness(star), e, 1e-14);
    EXPECT_NEAR(paper_roundness(1e-8 * star.array() + Complex(1.0, 1.0)), e, 1e-8);
    // The centre is weighted by length, the radius is not: a square with a point in the middle of one side has its
    // centre in the middle, four distances sqrt 2 and one of 1.
    VectorXcd square(5);
    square << Complex(0, 0), Complex(1, 0), Complex(2, 0), Complex(2, 2), Complex(0, 2);
    const double root = std::sqrt(2.0), radius = (4.0 * root + 1.0) / 5.0;
    const double squares = (4.0 * (root - radius) * (root - radius) + (1.0 - radius) * (1.0 - radius)) / 5.0;
    EXPECT_NEAR(paper_roundness(square), std::sqrt(squares) / radius, 1e-15);
    EXPECT_EQ(paper_roundness(VectorXcd::Constant(3, Complex(2.0, 1.0))), 1.0);
}

TEST(CircleFit, means_are_over_all_loops_and_over_the_holes)
{
    const MeanRoundness mean = mean_roundness({{0.1, 0.0}, {0.2, 0.5}, {0.6, 1.0}});
    EXPECT_NEAR(mean.all.paper, 0.3, 1e-15);
    EXPECT_NEAR(mean.holes.paper, 0.4, 1e-15);
    EXPECT_NEAR(mean.all.least_squares, 0.5, 1e-15);
    EXPECT_NEAR(mean.holes.least_squares, 0.75, 1e-15);
    EXPECT_EQ(mean_roundness({{0.1, 0.2}}).holes.paper, 0.0);
}

TEST(CircleFit, the_deviation_is_the_root_mean_square_of_the_relative_one)
{
    EXPECT_LT(deviation_from({{4.0, 4.0}, 2.0}, points_on({{4.0, 4.0}, 2.0}, 50, 0.7)), 1e-15);
    // Radius 1 + e cos 5t: root mean square e / sqrt 2, whatever the scale.
    const double e = 1e-3;
    for (const double scale : {1e-8, 1e8}) {
        VectorXcd points(400);
        for (int i = 0; i < 400; ++i)
            points[i] = std::polar(scale * (1.0 + e * std::cos(5.0 * 2.0 * pi * i / 400)), 2.0 * pi * i / 400);
        EXPECT_NEAR(deviation_from({{0.0, 0.0}, scale}, points), e / std::sqrt(2.0), 1e-6);
    }
}

TEST(CircleFit, inversive_distance_is_kept_by_moebius_maps)
{
    const Circle a{{0.3, 0.2}, 0.2}, b{{-0.4, 0.1}, 0.3}, unit;
    EXPECT_NEAR(inversive_distance(Circle{{0.0, 0.0}, 0.25}, unit), 0.5 * (4.0 + 0.25), 1e-14);
    const Moebius map{{0.35, -0.4}, std::polar(1.0, 0.7)};
    EXPECT_NEAR(inversive_distance(map(a), map(b)), inversive_distance(a, b), 1e-12);
    EXPECT_NEAR(inversive_distance(map(a), map(unit)), inversive_distance(a, unit), 1e-12);
}

TEST(CircleFit, a_loop_that_lies_on_a_short_arc_is_no_part_of_its_circle)
{
    const VectorXcd arc = points_on({{0.0, 0.0}, 1.0}, 1000).head(20);
    const Circle found = fit_circle_least_squares(arc);
    EXPECT_LT(found.radius, std::abs(arc[19] - arc[0]));
    EXPECT_LT(std::abs(found.center - arc.mean()), std::abs(arc[19] - arc[0]));
}

TEST(CircleFit, degenerate_loops_give_finite_circles)
{
    VectorXcd line(4);
    line << Complex(0, 0), Complex(1, 1), Complex(2, 2), Complex(3, 3);
    EXPECT_TRUE(std::isfinite(fit_circle_least_squares(line).radius));
    EXPECT_EQ(fit_circle_least_squares(VectorXcd::Constant(5, Complex(2.0, 1.0))).center, Complex(2.0, 1.0));
    EXPECT_EQ(fit_circle_paper(VectorXcd::Constant(1, Complex(2.0, 1.0))).radius, 0.0);
}
