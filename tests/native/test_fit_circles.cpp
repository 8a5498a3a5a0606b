#include "fit/fit_circles.h"

#include "bending/circle_path.h"
#include "circle_domain.h"
#include "circles/crowded_circles.h"
#include "core/errors.h"
#include "pipeline/uniformize.h"
#include "planar/boundary_crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

FitResult fitted(const Vertices& vertices, const Triangles& triangles, const CircleTemplate& wanted,
                 bool extremal = false)
{
    ExecutionContext context;
    return fit_circles(vertices, triangles, wanted, {.map = {}, .extremal = extremal}, context);
}

std::vector<Circle> holes_of(const std::vector<LoopReport>& loops)
{
    std::vector<Circle> holes;
    for (std::size_t k = 1; k < loops.size(); ++k) holes.push_back(loops[k].circle);
    return holes;
}

struct Domain {
    CircleDomain mesh = make_circle_domain(five_circles(), 1500);
    Vertices vertices = lift(mesh.points, Lift::polynomial);
    UniformizeResult conformal = uniformize(vertices, mesh.triangles);
};

const Domain& domain()
{
    static const Domain made;
    return made;
}

std::vector<Circle> random_holes(std::size_t count, std::mt19937& random)
{
    std::uniform_real_distribution<double> place(-1.0, 1.0), size(std::log(0.005), std::log(0.4));
    std::vector<Circle> circles{Circle{}};
    while (circles.size() <= count) {
        circles.push_back({{place(random), place(random)}, std::exp(size(random))});
        if (!is_apart(circles, circles.size() - 1, 1.05)) circles.pop_back();
    }
    return circles;
}

void expect_kept(const FitResult& result, const std::vector<Circle>& wanted)
{
    EXPECT_TRUE(result.distortion.flipped.empty());
    EXPECT_LT(result.residual, 1e-9);
    EXPECT_LT(result.of_faces.max, 1.0);
    ASSERT_EQ(result.loops.size(), wanted.size() + 1);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        const double area = -enclosed_area(result.loops[k + 1].vertices, result.uv);
        EXPECT_GT(area, 0.7 * std::numbers::pi * wanted[k].radius * wanted[k].radius);
        EXPECT_EQ(result.loops[k + 1].circle.center, wanted[k].center);
        EXPECT_EQ(result.loops[k + 1].circle.radius, wanted[k].radius);
        for (const Index v : result.loops[k + 1].vertices)
            EXPECT_NEAR(std::abs(Complex(result.uv(v, 0), result.uv(v, 1)) - wanted[k].center), wanted[k].radius, 1e-9);
    }
}

}  // namespace

TEST(CirclePath, circles_never_meet)
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t count = 1 + random() % 8;
        const std::vector<Circle> begin = random_holes(count, random);
        std::vector<Circle> end = trial % 2 == 0 ? random_holes(count, random) : begin;
        if (trial % 2 == 1) std::shuffle(end.begin() + 1, end.end(), random);
        const std::vector<CirclePath> paths = paths_between(begin, end);
        ASSERT_FALSE(paths.empty());
        for (int i = 0; i <= 1000; ++i) EXPECT_TRUE(circles_apart(paths.front().at(i / 1000.0))) << trial << " " << i;
    }
}

TEST(FitCircles, the_conformal_domain_stays)
{
    const CircleTemplate own{.circles = holes_of(domain().conformal.loops)};
    const FitResult result = fitted(domain().vertices, domain().mesh.triangles, own);
    EXPECT_LT((result.uv - domain().conformal.uv).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT(result.bending.max, 1e-5);
    EXPECT_FALSE(result.loops[1].shrunk);
}

TEST(FitCircles, a_cylinder_is_stretched_evenly)
{
    // Of all maps of a ring to a ring the radial power has the least sum: |mu| is (K - 1) / (K + 1) everywhere, K the
    // ratio of the moduli.
    constexpr Index sectors = 96, rings = 40;
    const double from = 0.2, to = 0.5;
    const CircleDomain ring = make_round_annulus(from, sectors, rings);
    Vertices cylinder(ring.points.size(), 3);
    for (Eigen::Index v = 0; v < cylinder.rows(); ++v) {
        const Complex z = ring.points[v];
        cylinder.row(v) << z.real() / std::abs(z), z.imag() / std::abs(z), std::log(std::abs(z));
    }
    const double dilatation = std::log(from) / std::log(to), mu = (dilatation - 1.0) / (dilatation + 1.0);
    const FitResult result = fitted(cylinder, ring.triangles, {.circles = {{0.0, to}}});
    EXPECT_NEAR(result.bending.mean, mu, 0.01 * mu);
    EXPECT_NEAR(result.bending.root_mean_square, mu, 0.01 * mu);
    EXPECT_NEAR(result.bending.max, mu, 0.05 * mu);
    for (Eigen::Index v = 0; v < cylinder.rows(); ++v)
        EXPECT_NEAR(result.uv.row(v).norm(), std::pow(std::abs(ring.points[v]), 1.0 / dilatation), 2e-3);
}

TEST(FitCircles, hard_templates_keep_faces_upright)
{
    const std::vector<Circle> own = holes_of(domain().conformal.loops);
    std::vector<std::vector<Circle>> templates(3, own);
    for (Circle& circle : templates[0]) circle.radius *= 0.1;
    for (std::size_t k = 0; k < own.size(); ++k) {
        const Complex spoke = std::polar(0.5, 0.5 * std::numbers::pi * static_cast<double>(k));
        templates[1][k] = {spoke, 0.34};
        templates[2][k] = {spoke, k == 0 ? 0.34 : 0.01};
    }
    for (const std::vector<Circle>& circles : templates)
        expect_kept(fitted(domain().vertices, domain().mesh.triangles, {.circles = circles}), circles);
}

TEST(FitCircles, circles_change_places)
{
    const std::vector<Circle> own = holes_of(domain().conformal.loops);
    const FitResult first = fitted(domain().vertices, domain().mesh.triangles, {.circles = own});
    std::vector<int> reversed(first.ranks.rbegin(), first.ranks.rend() - 1);
    std::vector<Circle> small = own;
    for (Circle& circle : small) circle.radius *= 0.7;
    const FitResult result = fitted(domain().vertices, domain().mesh.triangles, {.circles = small, .loops = reversed});
    expect_kept(result, small);
    for (std::size_t k = 0; k < own.size(); ++k)
        EXPECT_EQ(result.loops[k + 1].vertices, first.loops[own.size() - k].vertices);
}

TEST(FitCircles, pinned_and_fixed_rims)
{
    const std::vector<Circle> own = holes_of(domain().conformal.loops);
    const FitResult first = fitted(domain().vertices, domain().mesh.triangles, {.circles = own});
    const Index vertex = first.loops[2].vertices.front();
    CircleTemplate wanted{.circles = own, .loops = {first.ranks.begin() + 1, first.ranks.end()}};
    wanted.rims.resize(own.size());
    wanted.rims[1].pin = RimPin{vertex, 1.0};
    wanted.rims[2].rotates = false;
    const FitResult result = fitted(domain().vertices, domain().mesh.triangles, wanted);
    expect_kept(result, own);
    const Complex arm = Complex(result.uv(vertex, 0), result.uv(vertex, 1)) - own[1].center;
    EXPECT_NEAR(std::arg(arm), 1.0, 1e-9);
    for (const Index v : first.loops[3].vertices)
        EXPECT_LT((result.uv.row(v) - domain().conformal.uv.row(v)).norm(), 1e-6);
    wanted.rims[0].pin = RimPin{vertex, 0.0};
    EXPECT_THROW(fitted(domain().vertices, domain().mesh.triangles, wanted), InputError);
}

TEST(FitCircles, the_extremal_map_has_a_smaller_largest_mu)
{
    std::vector<Circle> wanted = holes_of(domain().conformal.loops);
    for (Circle& circle : wanted) circle.radius *= 0.5;
    const FitResult least = fitted(domain().vertices, domain().mesh.triangles, {.circles = wanted});
    const FitResult extremal = fitted(domain().vertices, domain().mesh.triangles, {.circles = wanted}, true);
    expect_kept(extremal, wanted);
    EXPECT_LT(extremal.bending.max, 0.8 * least.bending.max);
    EXPECT_LT(least.bending.root_mean_square, extremal.bending.root_mean_square);
}

TEST(FitCircles, infeasible_templates_are_refused)
{
    const auto refused = [](const CircleTemplate& wanted) {
        try {
            fitted(domain().vertices, domain().mesh.triangles, wanted);
        } catch (const InputError& error) {
            return error.elements();
        }
        ADD_FAILURE() << "not refused";
        return std::vector<Index>{};
    };
    const std::vector<Circle> own = holes_of(domain().conformal.loops);
    std::vector<Circle> circles = own;
    circles[2] = {own[1].center, 0.01};
    EXPECT_EQ(refused({.circles = circles}), (std::vector<Index>{1, 2}));
    circles[2] = {0.99, 0.02};
    EXPECT_EQ(refused({.circles = circles}), std::vector<Index>{2});
    for (const double radius : {0.0, -0.1, 1e-9, std::nan("")}) {
        circles[2] = {own[2].center, radius};
        EXPECT_EQ(refused({.circles = circles}), std::vector<Index>{2});
    }
    refused({.circles = {own[0]}});
    refused({.circles = own, .loops = {0, 1, 2, 99}});
    refused({.circles = own, .loops = {0, 1, 1, 2}});
}
