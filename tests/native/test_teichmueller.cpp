#include "core/complex_places.h"
#include "core/errors.h"
#include "fit/coarse_gaps.h"
#include "fit/dilatation_bounds.h"
#include "fit/plane_beltrami.h"
#include "fit/quasiconformal_map.h"
#include "fit/teichmueller.h"
#include "fit/torus_dilatation.h"
#include "mapped_domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

TeichmuellerMap extremal(const CircleDomain& a, const std::vector<Circle>& b, const std::vector<int>& match = {})
{
    ExecutionContext context;
    return teichmueller_map(mapped(a), b, {.match = match}, context);
}

std::vector<Circle> four_circles(double way)
{
    return {Circle{}, {{-0.4 + way, 0.1}, 0.2}, {{0.35, 0.3}, 0.15 + 0.2 * way}, {{0.2, -0.5 + way}, 0.25}};
}

/// exp of the hyperbolic distance.
double exp_distance(Complex z, Complex w)
{
    const double gap = std::norm(z - w) / (2.0 * z.imag() * w.imag());
    return 1.0 + gap + std::sqrt(gap * (gap + 2.0));
}

}  // namespace

TEST(Teichmueller, a_ring_has_the_ratio_of_the_moduli)
{
    const CircleDomain ring = make_round_annulus(0.2, 60, 24);
    for (const double radius : {0.05, 0.2, 0.5}) {
        const double ratio = std::log(0.2) / std::log(radius), exact = std::max(ratio, 1.0 / ratio);
        const TeichmuellerMap map = extremal(ring, {Circle{}, {0.0, radius}});
        EXPECT_NEAR(map.dilatation, exact, 1e-9 * exact);
        EXPECT_NEAR(map.distance(), 0.5 * std::log(exact), 1e-9);
        EXPECT_LT(map.largest, 1.05 * exact);
        EXPECT_NEAR(map.mu.mean(), (exact - 1.0) / (exact + 1.0), 0.01);
        EXPECT_EQ(map.flipped, 0U);
    }
}

TEST(Teichmueller, bounds_of_the_radial_map_meet)
{
    const CircleDomain ring = make_round_annulus(0.2, 96, 40);
    const PlanarPoints from = mapped(ring).uv;
    for (const double dilatation : {0.5, 1.5, 3.0}) {
        PlanarPoints to = from;
        for (Eigen::Index v = 0; v < to.rows(); ++v) to.row(v) *= std::pow(from.row(v).norm(), dilatation - 1.0);
        const DilatationBounds bounds = dilatation_bounds(ring.triangles, from, ring.circles, ring.loops, {},
                                                          plane_beltrami(from, ring.triangles, to));
        const double exact = std::max(dilatation, 1.0 / dilatation);
        EXPECT_NEAR(bounds.lower, exact, 0.005 * exact);
        EXPECT_NEAR(bounds.upper, exact, 0.005 * exact);
    }
}

TEST(Teichmueller, the_map_with_the_coefficients_of_the_radial_map)
{
    const CircleDomain ring = make_round_annulus(0.2, 96, 40);
    const PlanarPoints from = mapped(ring).uv;
    for (const double dilatation : {0.5, 1.5, 3.0}) {
        VectorXcd mu(ring.triangles.rows());
        for (Eigen::Index f = 0; f < mu.size(); ++f) {
            Complex middle = 0.0;
            for (const Index v : ring.triangles.row(f)) middle += complex_at(from, v);
            mu[f] = (dilatation - 1.0) / (dilatation + 1.0) * middle / std::conj(middle);
        }
        ExecutionContext context;
        const auto to = quasiconformal_map(ring.triangles, from, ring.loops, mu,
                                           {Circle{}, {0.0, std::pow(0.2, dilatation)}}, context);
        ASSERT_TRUE(to.has_value());
        for (Eigen::Index v = 0; v < from.rows(); ++v)
            EXPECT_NEAR(to->row(v).norm(), std::pow(from.row(v).norm(), dilatation), 1e-3);
    }
}

TEST(Teichmueller, no_way_to_the_own_domain)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1500);
    const TeichmuellerMap map = extremal(domain, domain.circles);
    EXPECT_LT(map.distance(), 1e-5);
    EXPECT_LT((map.uv - mapped(domain).uv).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_EQ(map.match, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Teichmueller, there_and_back_and_the_triangle_inequality)
{
    const std::vector<int> match{0, 1, 2, 3};
    std::vector<CircleDomain> domains;
    for (const double way : {0.0, 0.12, 0.2}) domains.push_back(make_circle_domain(four_circles(way), 1500));
    MatrixXd distance(3, 3);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const TeichmuellerMap map = extremal(domains[i], domains[j].circles, match);
            distance(i, j) = map.distance();
            EXPECT_LE(map.lower, map.dilatation);
            EXPECT_LE(map.dilatation, map.largest);
            EXPECT_LT(map.largest, 1.2 * map.lower) << i << j;
        }
    EXPECT_LT((distance - distance.transpose()).cwiseAbs().maxCoeff(), 0.02 * distance.maxCoeff());
    EXPECT_LT(distance.diagonal().maxCoeff(), 1e-4);
    EXPECT_LE(distance(0, 2), 1.01 * (distance(0, 1) + distance(1, 2)));
    EXPECT_LE(distance(0, 1), distance(0, 2) + distance(2, 1));
}

TEST(Teichmueller, bounds_see_what_products_of_measures_miss)
{
    // All centres lie on a line, and one hole moves off it.
    const std::vector<Circle> line{Circle{}, {-0.5, 0.15}, {0.0, 0.15}, {0.5, 0.15}};
    std::vector<Circle> bent = line;
    bent[2].center = Complex(0.0, 0.3);
    const TeichmuellerMap map = extremal(make_circle_domain(line, 3000), bent, {0, 1, 2, 3});
    EXPECT_GT(map.lower, 1.2);
    EXPECT_LT(map.largest, 1.1 * map.lower);
}

TEST(Teichmueller, of_tori)
{
    const Complex i(0.0, 1.0);
    EXPECT_NEAR(torus_dilatation(i, 2.0 * i), 2.0, 1e-14);
    EXPECT_NEAR(torus_dilatation(i, 1.0 + i), 1.0, 1e-14);
    EXPECT_NEAR(torus_dilatation(3.0 * i, i / 4.0), 4.0 / 3.0, 1e-14);
    EXPECT_NEAR(torus_dilatation({0.5, 2.0}, {-0.5, 2.0}), 1.0, 1e-14);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-2.0, 2.0), height(-0.5, 2.0);
    for (int trial = 0; trial < 200; ++trial) {
        const Complex z(place(random), std::exp(height(random))), w(place(random), std::exp(height(random)));
        double least = exp_distance(z, w);
        for (long a = -12; a <= 12; ++a)
            for (long b = -12; b <= 12; ++b)
                for (long c = -12; c <= 12; ++c) {
                    if (a == 0 ? b * c != -1 : (1 + b * c) % a != 0) continue;
                    for (long d = a == 0 ? -12 : (1 + b * c) / a; d <= (a == 0 ? 12 : (1 + b * c) / a); ++d)
                        least =
                            std::min(least, exp_distance(z, (double(a) * w + double(b)) / (double(c) * w + double(d))));
                }
        const double found = torus_dilatation(z, w);
        EXPECT_LE(found, least * (1.0 + 1e-9));
        EXPECT_GT(found, 0.97 * least) << z << w;  // words of larger numbers may be nearer
        EXPECT_NEAR(found, torus_dilatation(w, z), 1e-9 * found);
    }
    EXPECT_THROW(torus_dilatation(i, {1.0, 0.0}), InputError);
    EXPECT_THROW(torus_dilatation({std::nan(""), 1.0}, i), InputError);
    EXPECT_THROW(torus_dilatation(1e-300 * i, i), InputError);
}

TEST(Teichmueller, refuses_other_domains)
{
    const CircleDomain domain = make_circle_domain(four_circles(0.0), 600);
    const std::vector<Circle> b = four_circles(0.1);
    EXPECT_THROW(extremal(domain, {b[0], b[1]}), InputError);
    EXPECT_THROW(extremal(domain, b, {0, 1, 2}), InputError);
    EXPECT_THROW(extremal(domain, b, {1, 0, 2, 3}), InputError);
    EXPECT_THROW(extremal(domain, b, {0, 1, 1, 2}), InputError);
    EXPECT_THROW(extremal(domain, {b[0], b[1], b[1], b[2]}), InputError);
    EXPECT_THROW(extremal(domain, {b[1], b[0], b[2], b[3]}), InputError);
}

TEST(Teichmueller, a_gap_is_coarse_if_edges_leave_the_circles_by_more)
{
    const std::vector<Circle> circles{{0.0, 1.0}, {-0.3, 0.29}, {0.3, 0.29}};  // with gaps of 0.41, 0.41 and 0.02
    const auto rims = [&](int count) {
        std::vector<VertexLoop> loops(circles.size());
        PlanarPoints uv(static_cast<Eigen::Index>(circles.size()) * count, 2);
        Index v = 0;
        for (std::size_t k = 0; k < circles.size(); ++k)
            for (int i = 0; i < count; ++i) {
                const Complex z =
                    circles[k].center + std::polar(circles[k].radius, 2.0 * std::numbers::pi * (i + 0.5) / count);
                loops[k].push_back(v);
                uv.row(v++) << z.real(), z.imag();
            }
        return coarse_gap(circles, loops, uv);
    };
    // An edge of n leaves a circle by 0.29 (1 - cos(pi / n)): by 0.014 for 10 edges, and by 0.007 for 14.
    EXPECT_EQ(rims(10), (std::pair<Index, Index>{1, 2}));
    EXPECT_FALSE(rims(14));
}
