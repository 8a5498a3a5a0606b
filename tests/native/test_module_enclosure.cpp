#include "certified/capacities.h"
#include "certified/circle_bounds.h"
#include "certified/circle_capacities.h"
#include "certified/interval_functions.h"
#include "circle_domain.h"
#include "shape/conformal_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

/// Circles of about the same size, on a ring round the middle one.
std::vector<Circle> some_circles(std::mt19937& random, int count)
{
    std::uniform_real_distribution<double> number(0.0, 1.0);
    std::vector<Circle> circles{{}, {0.05 * Complex(number(random), number(random)), 0.12 + 0.08 * number(random)}};
    for (int k = 2; k < count; ++k)
        circles.push_back({std::polar(0.55 + 0.08 * number(random), 6.2 * (k - 2 + 0.4 * number(random)) / (count - 2)),
                           0.05 + 0.08 * number(random)});
    return circles;
}

std::vector<Circle> first_circles(std::size_t count)
{
    std::vector<Circle> circles = five_circles();
    circles.resize(count);
    return circles;
}

CircleCapacities near(const VectorXd& module)
{
    ExecutionContext context;
    return {module, 1e-8, context};
}

CapacityReport enclosed(const Vertices& vertices, const Triangles& triangles, std::optional<double> width)
{
    ExecutionContext context;
    return certified_capacities(vertices, triangles, {}, {.width = width}, context);
}

/// Two regular hexagons, glued along every other side, of 6 n^2 faces each.
std::pair<Vertices, Triangles> doubled_hexagon(int n)
{
    std::vector<Eigen::Vector3d> points;
    std::map<std::array<int, 3>, Index> number;  // of lattice points (a, b) of a side
    const auto at = [&](int a, int b, int side) {
        const bool glued = a + b == n || a == -n || b == -n;
        const auto [entry, is_new] = number.try_emplace({a, b, glued ? 0 : side}, static_cast<Index>(points.size()));
        if (is_new) points.emplace_back(a + 0.5 * b, std::sqrt(0.75) * b, 0.0);
        return entry->second;
    };
    const auto inside = [&](int a, int b) { return std::max({std::abs(a), std::abs(b), std::abs(a + b)}) <= n; };
    std::vector<std::array<Index, 3>> faces;
    for (const int side : {0, 1})
        for (int a = -n; a <= n; ++a)
            for (int b = -n; b <= n; ++b)
                for (const int up : {1, -1}) {
                    if (!inside(a, b) || !inside(a + up, b) || !inside(a, b + up)) continue;
                    std::array<Index, 3> face{at(a, b, side), at(a + up, b, side), at(a, b + up, side)};
                    if (side == 1) std::swap(face[1], face[2]);
                    faces.push_back(face);
                }
    std::pair<Vertices, Triangles> surface{Vertices(points.size(), 3), Triangles(faces.size(), 3)};
    for (std::size_t v = 0; v < points.size(); ++v) surface.first.row(v) = points[v];
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) surface.second(f, k) = faces[f][k];
    return surface;
}

/// The module of circles whose polygons a domain's loops are, in the order of the report.
VectorXd exact_module(const CircleDomain& domain, const std::vector<Circle>& circles, const std::vector<int>& order)
{
    std::vector<std::pair<Index, int>> lowest;  // loops are numbered by their lowest vertices
    for (std::size_t k = 0; k < circles.size(); ++k)
        lowest.emplace_back(*std::ranges::min_element(domain.loops[k]), static_cast<int>(k));
    std::ranges::sort(lowest);
    std::vector<int> of_circles;
    of_circles.reserve(order.size());
    for (const int loop : order) of_circles.push_back(lowest[loop].second);
    return conformal_module(circles, of_circles);
}

}  // namespace

TEST(ModuleEnclosure, the_module_gives_the_circles)
{
    std::mt19937 random(1);
    for (const int count : {3, 4, 7}) {
        const std::vector<Circle> wanted = normalized_circles(some_circles(random, count));
        const std::vector<Circle> found = circles_of_module(conformal_module(wanted));
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            EXPECT_LT(std::abs(found[k].center - wanted[k].center), 1e-14);
            EXPECT_NEAR(found[k].radius, wanted[k].radius, 1e-14);
        }
    }
}

TEST(ModuleEnclosure, functions_of_intervals_hold_those_of_long_doubles_closely)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-700.0, 700.0), number(0.0, 1.0);
    const auto holds = [](const Interval& found, long double exact) {
        const long double rounding = 1e-18L * (1.0L + std::abs(exact));  // of the long doubles
        EXPECT_LE(found.lower, exact + rounding);
        EXPECT_GE(found.upper, exact - rounding);
        EXPECT_LE(found.width(), 1e-15 * (8.0 + 40.0 * static_cast<double>(std::abs(exact))));
    };
    for (int i = 0; i < 2000; ++i) {
        const double x = std::exp(exponent(random)), small = 1.0 + (number(random) - 0.5) * 1e-3,
                     y = 3.0 * number(random);
        holds(logarithm(Interval(x)), std::log(static_cast<long double>(x)));
        holds(logarithm(Interval(small)), std::log(static_cast<long double>(small)));
        holds(exponential_between(Interval(-y)), std::exp(-static_cast<long double>(y)));
        const auto whole = static_cast<std::ptrdiff_t>(1 + 3000 * number(random));
        const auto part = static_cast<std::ptrdiff_t>(static_cast<double>(whole) * number(random));
        const long double angle =
            2.0L * std::numbers::pi_v<long double> * static_cast<long double>(part) / static_cast<long double>(whole);
        const Plane<Interval> root = unit_root(part, whole);
        holds(root.re, std::cos(angle));
        holds(root.im, std::sin(angle));
    }
    EXPECT_EQ(exponential_between(Interval(-1e6)).lower, 0.0);
    EXPECT_GT(exponential_between(Interval(-1e6)).upper, 0.0);
    EXPECT_FALSE(std::isfinite(logarithm(Interval(-1.0, 1.0)).width()));
}

TEST(ModuleEnclosure, capacities_of_a_small_circle_near_the_rim_are_known_well)
{
    const VectorXd module = Eigen::Vector3d(0.32, 0.9947, 0.0036);
    std::vector<Condenser> condensers = loop_condensers(3);
    EXPECT_LT(near(module).errors(condensers, VectorXd::Zero(3)).maxCoeff(), 1e-7);
}

// An automorphism of the disk that brings another circle to the middle changes no capacity.
TEST(ModuleEnclosure, capacities_of_circles_do_not_depend_on_the_position)
{
    std::mt19937 random(2);
    for (const int count : {3, 4}) {
        const std::vector<Circle> circles = some_circles(random, count);
        const std::vector<Condenser> condensers = loop_condensers(count);
        const CircleCapacities first = near(conformal_module(circles));
        std::vector<int> order(count);  // the unit circle first, the others in the opposite order
        for (int k = 1; k < count; ++k) order[k] = count - k;
        std::vector<Condenser> renumbered = condensers;
        for (Condenser& condenser : renumbered)
            for (std::vector<int>* side : {&condenser.at_zero, &condenser.at_one})
                for (int& k : *side) k = k == 0 ? 0 : count - k;
        const CircleCapacities second = near(conformal_module(circles, order));
        const VectorXd none = VectorXd::Zero(first.module().size());
        const VectorXd errors = first.errors(condensers, none) + second.errors(renumbered, none);
        EXPECT_LT(first.errors(condensers, none).maxCoeff(), 1e-6);
        EXPECT_LT(errors.maxCoeff(), 1e-3);  // circles crowd at the rim in the second position
        const VectorXd apart = (first.values(condensers) - second.values(renumbered)).cwiseAbs();
        for (Eigen::Index c = 0; c < apart.size(); ++c) EXPECT_LE(apart[c], errors[c]) << count << ' ' << c;
    }
}

TEST(ModuleEnclosure, the_linear_function_is_as_near_as_it_says)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-1.0, 1.0);
    for (const int count : {3, 4}) {
        const CircleCapacities middle = near(conformal_module(some_circles(random, count)));
        const std::vector<Condenser> condensers = loop_condensers(count);
        double largest_share = 0.0;
        for (const double size : {1e-2, 1e-3, 1e-4}) {
            const VectorXd reach = VectorXd::Constant(middle.module().size(), size);
            const VectorXd errors = middle.errors(condensers, reach);
            EXPECT_LT(errors.maxCoeff(), 1e5 * size * size);
            for (int i = 0; i < 4; ++i) {
                const VectorXd step = reach.unaryExpr([&](double r) { return side(random) < 0.0 ? -r : r; });
                const CircleCapacities there = near(middle.module() + step);
                const VectorXd own = there.errors(condensers, VectorXd::Zero(step.size()));
                const VectorXd found = there.values(condensers);
                const VectorXd linear = middle.values(condensers) + middle.gradients(condensers) * step;
                for (Eigen::Index c = 0; c < found.size(); ++c) {
                    EXPECT_LE(std::abs(found[c] - linear[c]), errors[c] + own[c]);
                    largest_share = std::max(largest_share, std::abs(found[c] - linear[c]) / errors[c]);
                }
            }
        }
        EXPECT_GT(largest_share, 1e-3);  // the bounds are not far from what happens
    }
}

// Polygons with their corners on known circles: with n edges their module differs from the circles' by O(1/n^2).
TEST(ModuleEnclosure, slow_polygons_have_nearly_the_module_of_their_circles)
{
    for (const std::size_t count : {3, 4}) {
        const std::vector<Circle> circles = first_circles(count);
        double before = 1.0;
        for (const Index faces : {600, 2400}) {
            const CircleDomain domain = make_circle_domain(circles, faces);
            const CapacityReport report = enclosed(lift(domain.points, Lift::plane), domain.triangles, 5e-4);
            ASSERT_EQ(report.no_module, "");
            EXPECT_TRUE(report.converged);
            const VectorXd exact = exact_module(domain, circles, report.order);
            ASSERT_EQ(static_cast<Eigen::Index>(report.module.size()), exact.size());
            double error = 0.0;
            for (Eigen::Index l = 0; l < exact.size(); ++l) {
                EXPECT_LE(report.module[l].width(), 5e-4);
                error = std::max(error, std::abs(0.5 * (report.module[l].lower + report.module[l].upper) - exact[l]));
            }
            EXPECT_LT(error, 0.02);
            EXPECT_LT(error, before / 2.5);
            before = error;
        }
    }
}

// Circle 2 is nearer to the unit circle than its own radius: a term of the series grows as fast there as samples fall.
TEST(ModuleEnclosure, circles_near_the_rim_are_enclosed)
{
    const std::vector<Circle> circles{{}, {0.0, 0.226}, {{0.0, 0.82}, 0.094}};
    const CircleDomain domain = make_circle_domain(circles, 1500);
    const CapacityReport report = enclosed(lift(domain.points, Lift::plane), domain.triangles, 1e-3);
    ASSERT_EQ(report.no_module, "");
    EXPECT_LT(report.faces, 10000);
    const VectorXd exact = exact_module(domain, circles, report.order);
    for (Eigen::Index l = 0; l < exact.size(); ++l)
        EXPECT_NEAR(0.5 * (report.module[l].lower + report.module[l].upper), exact[l], 0.01);
}

// Three sides of a hexagon go over into three others if it is turned: the capacities between three sides, with no flux
// through the others, are 1 / sqrt(3), and twice as much on both sides. Numbers of the module to all digits that stand.
TEST(ModuleEnclosure, a_doubled_hexagon_is_enclosed)
{
    const auto [vertices, triangles] = doubled_hexagon(4);
    const CapacityReport report = enclosed(vertices, triangles, 1e-4);
    ASSERT_EQ(report.no_module, "");
    for (const Capacity& capacity : report.capacities) {
        EXPECT_LE(capacity.value.lower, 4.0 / std::sqrt(3.0));
        EXPECT_GE(capacity.value.upper, 4.0 / std::sqrt(3.0));
    }
    const double exact[] = {0.02594142, 0.16303084, 0.02525147};
    ASSERT_EQ(report.module.size(), std::size(exact));
    for (std::size_t l = 0; l < std::size(exact); ++l) {
        EXPECT_LE(report.module[l].lower, exact[l] + 5e-9);
        EXPECT_GE(report.module[l].upper, exact[l] - 5e-9);
    }
}

// The same surface in another unit, its triangles cut.
TEST(ModuleEnclosure, slow_enclosures_of_one_surface_meet)
{
    for (const std::size_t count : {3, 4}) {
        const CircleDomain domain = make_circle_domain(first_circles(count), 500);
        const Vertices vertices = lift(domain.points, Lift::enneper);
        const CapacityReport first = enclosed(vertices, domain.triangles, 1e-2);
        const CapacityReport second = enclosed(1000.0 * vertices, domain.triangles, 1e-3);
        ASSERT_EQ(first.no_module + second.no_module, "");
        EXPECT_EQ(first.order, second.order);
        for (std::size_t l = 0; l < first.module.size(); ++l) {
            EXPECT_LE(second.module[l].width(), 1e-3);
            EXPECT_LE(std::max(first.module[l].lower, second.module[l].lower),
                      std::min(first.module[l].upper, second.module[l].upper));
        }
    }
}

// Four circles with their centres on one line are their own mirror image: to first order no capacity tells x_3.
TEST(ModuleEnclosure, without_bounds_it_says_why)
{
    const std::vector<Circle> symmetric{{}, {{-0.5, 0.0}, 0.15}, {{0.0, 0.0}, 0.2}, {{0.5, 0.0}, 0.1}};
    const CircleDomain four = make_circle_domain(symmetric, 500), five = make_circle_domain(five_circles(), 300);
    for (const CircleDomain* domain : {&four, &five}) {
        const CapacityReport report = enclosed(lift(domain->points, Lift::plane), domain->triangles, {});
        EXPECT_TRUE(report.converged);
        EXPECT_TRUE(report.module.empty());
        EXPECT_NE(report.no_module, "");
    }
}
