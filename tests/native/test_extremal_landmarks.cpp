#include "conformal/rectangle_modulus.h"
#include "core/complex_places.h"
#include "core/errors.h"
#include "fit/bounded_matches.h"
#include "fit/teichmueller.h"
#include "mapped_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

TeichmuellerMap held_map(const CircleDomain& a, const std::vector<Circle>& b, const std::vector<HeldPoint>& landmarks)
{
    ExecutionContext context;
    return teichmueller_map(mapped(a), b, {.landmarks = landmarks}, context);
}

SurfacePoint at_vertex(const Triangles& triangles, Index v)
{
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (triangles(f, k) == v) return {static_cast<Index>(f), Eigen::RowVector3d::Unit(k)};
    return {};
}

/// The vertex of the outer rim nearest to an angle.
Index rim_vertex(const CircleDomain& domain, double angle)
{
    return *std::ranges::min_element(domain.loops[0], {},
                                     [&](Index v) { return std::abs(domain.points[v] - std::polar(1.0, angle)); });
}

/// Modulus of the unit disk without the segment from -p to p, over 2 pi: Groetzsch's ring.
double slit_modulus(double p)
{
    const double k = 2.0 * p / (1.0 + p * p);
    return std::comp_ellint_1(std::sqrt(1.0 - k * k)) / std::comp_ellint_1(k) / 4.0;
}

}  // namespace

TEST(RectangleModulus, known_values_and_laws)
{
    const Complex i(0.0, 1.0);
    EXPECT_NEAR(rectangle_modulus({1.0, i, -1.0, -i}), 1.0, 1e-15);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> turn(0.0, 2.0 * std::numbers::pi), way(-0.9, 0.9);
    for (int trial = 0; trial < 300; ++trial) {
        std::array<double, 4> angle{turn(random), turn(random), turn(random), turn(random)};
        std::ranges::sort(angle);
        std::array<Complex, 4> z{}, w{}, next{};
        const Complex a = std::polar(std::abs(way(random)), turn(random));
        for (std::size_t k = 0; k < 4; ++k) {
            z[k] = std::polar(1.0, angle[k]);
            w[k] = (z[k] - a) / (1.0 - std::conj(a) * z[k]);
            next[(k + 3) % 4] = z[k];
        }
        const double modulus = rectangle_modulus(z);
        EXPECT_NEAR(rectangle_modulus(w), modulus, 1e-8 * modulus);
        EXPECT_NEAR(rectangle_modulus(next) * modulus, 1.0, 1e-9);
        const double k = std::sqrt(std::norm((z[0] - z[1]) * (z[2] - z[3]) / ((z[0] - z[2]) * (z[1] - z[3]))));
        const double below = std::sqrt(std::norm((z[1] - z[2]) * (z[3] - z[0]) / ((z[0] - z[2]) * (z[1] - z[3]))));
        EXPECT_NEAR(modulus, std::comp_ellint_1(std::sqrt(k)) / std::comp_ellint_1(std::sqrt(below)), 1e-7 * modulus);
    }
}

TEST(ExtremalLandmarks, four_corners_have_the_ratio_of_the_moduli)
{
    const CircleDomain disk = make_circle_domain({Circle{}}, 1500);
    for (const double narrow : {0.0, 0.2, 0.4, -0.4}) {
        std::vector<HeldPoint> corners;
        std::array<Complex, 4> here{}, there{};
        for (int k = 0; k < 4; ++k) {
            const double angle = 0.5 * std::numbers::pi * k;
            const Index v = rim_vertex(disk, angle);
            here[k] = disk.points[v];
            there[k] = std::polar(1.0, angle + (k % 2 == 0 ? narrow : 0.0));
            corners.push_back({at_vertex(disk.triangles, v), there[k]});
        }
        const TeichmuellerMap map = held_map(disk, {Circle{}}, corners);
        const double ratio = rectangle_modulus(here) / rectangle_modulus(there);
        EXPECT_NEAR(map.dilatation, std::max(ratio, 1.0 / ratio), 1e-9);
        EXPECT_LT(map.largest, 1.02 * map.dilatation);
        EXPECT_NEAR(map.mu.mean(), (map.dilatation - 1.0) / (map.dilatation + 1.0), 0.003);
        for (int k = 0; k < 4; ++k)
            EXPECT_LT(std::abs(complex_at(map.uv, rim_vertex(disk, 0.5 * std::numbers::pi * k)) - there[k]), 1e-9);
    }
}

TEST(ExtremalLandmarks, two_points_of_a_disk_are_those_of_a_slit)
{
    const CircleDomain disk = make_circle_domain({Circle{}}, 3000);
    const Index left = vertex_near(disk, -0.4), right = vertex_near(disk, 0.4);
    const Complex a = disk.points[left], b = disk.points[right];
    const double half = std::tanh(0.5 * std::atanh(std::abs((a - b) / (1.0 - std::conj(a) * b))));
    for (const double wide : {0.3, 0.7}) {
        const double ratio = slit_modulus(half) / slit_modulus(wide), exact = std::max(ratio, 1.0 / ratio);
        const TeichmuellerMap map = held_map(
            disk, {Circle{}}, {{at_vertex(disk.triangles, left), -wide}, {at_vertex(disk.triangles, right), wide}});
        EXPECT_NEAR(map.dilatation, exact, 0.004 * exact);
        EXPECT_NEAR(map.lower, exact, 0.004 * exact);
        EXPECT_LT(map.largest, 1.04 * exact);
        EXPECT_NEAR(map.mu.mean(), (exact - 1.0) / (exact + 1.0), 0.01);
    }
}

TEST(ExtremalLandmarks, marks_of_all_kinds_have_bounds_that_nearly_meet)
{
    const CircleDomain disk = make_circle_domain({Circle{}}, 1500);
    const CircleDomain ring = make_round_annulus(0.4, 80, 16);
    const auto moved = [](const CircleDomain& domain, Index v, Complex factor) {
        return HeldPoint{at_vertex(domain.triangles, v), domain.points[v] * factor};
    };
    const Complex on = std::polar(1.0, 0.15), back = std::polar(1.0, -0.15);
    const auto rim = [&](double angle, Complex factor) { return moved(disk, rim_vertex(disk, angle), factor); };
    const std::vector<HeldPoint> five{rim(0.0, on), rim(1.0, 1.0), rim(2.0, back), rim(3.5, 1.0), rim(5.0, on)},
        mixed{rim(0.0, 1.0), rim(3.0, on), moved(disk, vertex_near(disk, {0.2, 0.5}), 0.8),
              moved(disk, vertex_near(disk, {-0.3, -0.2}), 1.2)},
        lone{moved(disk, vertex_near(disk, 0.4), 1.0), moved(disk, vertex_near(disk, -0.4), 0.8 * on), rim(1.5, on)},
        twisted{moved(ring, ring.loops[0][0], on), moved(ring, ring.loops[1][3], back)},
        on_ring{moved(ring, ring.loops[0][0], on), moved(ring, vertex_near(ring, 0.7), 1.1)};
    for (const auto& marks : {five, mixed, lone}) {
        const TeichmuellerMap map = held_map(disk, {Circle{}}, marks);
        EXPECT_GT(map.lower, 1.02);
        EXPECT_LT(map.largest, 1.06 * map.lower) << map.dilatation;
    }
    for (const auto& marks : {twisted, on_ring}) {
        const TeichmuellerMap map = held_map(ring, {Circle{}, {0.0, 0.4}}, marks);
        EXPECT_GT(map.lower, 1.02);
        EXPECT_LT(map.largest, 1.08 * map.lower) << map.dilatation;
    }
}

TEST(ExtremalLandmarks, a_bound_of_a_match_is_below_its_dilatation)
{
    std::vector<Circle> from = five_circles();
    from.pop_back();
    std::vector<Circle> to{Circle{}, from[3], from[1], from[2]};
    for (std::size_t k = 1; k < to.size(); ++k) to[k].radius *= 0.8;
    const CircleDomain domain = make_circle_domain(from, 500);
    ExecutionContext context;
    const auto all = bounded_matches(domain.circles, to, 1e300, context);
    EXPECT_EQ(all.size(), 6U);
    EXPECT_TRUE(std::ranges::is_sorted(all));
    double least = 1e300;
    int mapped_count = 0;
    for (const auto& [bound, match] : all) {
        try {
            const TeichmuellerMap map = teichmueller_map(mapped(domain), to, {.match = match}, context);
            EXPECT_LE(bound, 1.001 * map.dilatation);
            least = std::min(least, map.dilatation);
            ++mapped_count;
        } catch (const SolverError&) {
        }
    }
    EXPECT_GT(mapped_count, 2);
    const TeichmuellerMap map = teichmueller_map(mapped(domain), to, {.least_match = true}, context);
    EXPECT_EQ(map.dilatation, least);
    EXPECT_EQ(map.match, (std::vector<int>{0, 2, 3, 1}));
}

TEST(ExtremalLandmarks, refuses_what_excludes_itself)
{
    const CircleDomain disk = make_circle_domain({Circle{}}, 400);
    const HeldPoint inside{at_vertex(disk.triangles, vertex_near(disk, 0.2)), {0.3, 0.0}};
    const HeldPoint rim{at_vertex(disk.triangles, rim_vertex(disk, 1.0)), std::polar(1.0, 1.0)};
    EXPECT_THROW(held_map(disk, {Circle{}}, {inside, {inside.point, {0.5, 0.0}}}), InputError);
    EXPECT_THROW(held_map(disk, {Circle{}}, {{rim.point, 0.9 * rim.place}}), InputError);
    EXPECT_THROW(held_map(disk, {Circle{}}, {{inside.point, rim.place}}), InputError);
    EXPECT_THROW(held_map(disk, {Circle{}}, {{inside.point, std::nan("")}}), InputError);
    ExecutionContext context;
    EXPECT_THROW(teichmueller_map(mapped(disk), {Circle{}}, {.landmarks = {rim}, .least_match = true}, context),
                 InputError);
}
