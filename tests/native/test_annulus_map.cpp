#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "conformal/annulus_map.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "second_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

using namespace koebe;
using namespace koebe::test;

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

struct RingSample {
    CircleDomain domain;
    EdgeLengths lengths, weights;
    Index vertex_count;
    AnnulusMap map;

    explicit RingSample(CircleDomain of, Lift kind = Lift::plane, double scale = 1.0)
        : domain(std::move(of)),
          lengths(edge_lengths(Vertices(scale * lift(domain.points, kind)), domain.triangles)),
          weights(half_cotangents(lengths)),
          vertex_count(static_cast<Index>(domain.points.size())),
          map(annulus_map(domain.triangles, lengths, vertex_count, domain.loops[0], domain.loops[1]))
    {
    }
    OneForm df() const { return exterior_derivative(domain.triangles, map.f); }
    OneForm dg() const
    {
        return exterior_derivative_of_corners(map.g0) + exterior_derivative(domain.triangles, map.g1);
    }
};

/// Largest distance from the expected map, the best rotation taken out.
double distance_up_to_rotation(const VectorXcd& found, const VectorXcd& expected)
{
    Complex turn = (found.array() * expected.array().conjugate()).sum();
    turn /= std::abs(turn);
    return (found.array() - turn * expected.array()).abs().maxCoeff();
}

}  // namespace

TEST(AnnulusMap, the_cut_is_a_path_of_inner_vertices_from_one_loop_to_the_other)
{
    const RingSample sample(eccentric_annulus(1500), Lift::enneper);
    std::set<Index> on_loops;
    for (const VertexLoop& loop : sample.domain.loops) on_loops.insert(loop.begin(), loop.end());
    const auto& cut = sample.map.cut;
    ASSERT_FALSE(cut.empty());
    const auto contains = [](const VertexLoop& loop, Index v) {
        return std::find(loop.begin(), loop.end(), v) != loop.end();
    };
    EXPECT_TRUE(contains(sample.domain.loops[0], origin(sample.domain.triangles, cut.front())));
    EXPECT_TRUE(contains(sample.domain.loops[1], target(sample.domain.triangles, cut.back())));
    double length = 0.0;
    for (std::size_t i = 0; i < cut.size(); ++i) {
        length += sample.lengths.data()[cut[i]];
        if (i == 0) continue;
        EXPECT_EQ(origin(sample.domain.triangles, cut[i]), target(sample.domain.triangles, cut[i - 1]));
        EXPECT_EQ(on_loops.count(origin(sample.domain.triangles, cut[i])), 0u);
    }
    // No shorter than the gap, and a path of edges of a good mesh is at most 2 / sqrt(3) longer, plus an edge.
    const RingSample plane(eccentric_annulus(1500));
    double plane_length = 0.0;
    for (const Index h : plane.map.cut) plane_length += plane.lengths.data()[h];
    const double gap = 1.0 - std::abs(Complex(0.4, 0.2)) - 0.25;
    EXPECT_GE(plane_length, gap);
    EXPECT_LE(plane_length, 1.2 * gap + 0.06);
    EXPECT_GT(length, 0.0);
}

TEST(AnnulusMap, f_is_harmonic_between_its_boundary_values)
{
    const RingSample sample(eccentric_annulus(1500), Lift::enneper);
    VectorXd divergence_of_df = divergence(sample.domain.triangles, sample.weights, sample.df(), sample.vertex_count);
    for (int k = 0; k < 2; ++k)
        for (const Index v : sample.domain.loops[k]) {
            EXPECT_EQ(sample.map.f[v], k);
            divergence_of_df[v] = 0.0;
        }
    EXPECT_LT(divergence_of_df.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GE(sample.map.f.minCoeff(), 0.0);
    EXPECT_LE(sample.map.f.maxCoeff(), 1.0);
}

TEST(AnnulusMap, dg0_is_closed_has_period_one_and_is_one_form_on_the_surface)
{
    const RingSample sample(eccentric_annulus(1500));
    const OneForm dg0 = exterior_derivative_of_corners(sample.map.g0);
    EXPECT_EQ(circulation(dg0).cwiseAbs().maxCoeff(), 0.0);
    const std::vector<Index> twin = pair_halfedges(sample.domain.triangles, sample.vertex_count);
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] != no_twin) {
            EXPECT_EQ(dg0[h], -dg0[twin[h]]);
        }
    for (const VertexLoop& loop : sample.domain.loops) {
        std::set<Index> members(loop.begin(), loop.end());
        double period = 0.0;
        for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
            if (twin[h] == no_twin && members.count(origin(sample.domain.triangles, h))) period += dg0[h];
        EXPECT_EQ(std::abs(period), 1.0);
    }
}

TEST(AnnulusMap, dg_is_harmonic_and_flows_through_no_loop)
{
    const RingSample sample(eccentric_annulus(1500), Lift::sphere);
    EXPECT_LT(circulation(sample.dg()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT(
        divergence(sample.domain.triangles, sample.weights, sample.dg(), sample.vertex_count).cwiseAbs().maxCoeff(),
        1e-11);
}

TEST(AnnulusMap, df_wedge_dg_is_one_and_lambda_lies_between_the_conjugate_estimates)
{
    for (const Lift kind : {Lift::plane, Lift::sphere, Lift::enneper}) {
        const RingSample sample(eccentric_annulus(1500), kind);
        EXPECT_NEAR(wedge_integral(sample.df(), sample.dg()), 1.0, 1e-12);
        const double upper = squared_norm(sample.weights, sample.df());
        const double lower = 1.0 / squared_norm(sample.weights, sample.dg());
        EXPECT_LT(lower, sample.map.lambda);
        EXPECT_LT(sample.map.lambda, upper);
        EXPECT_LT(upper - lower, 0.02 * upper);
    }
}

TEST(AnnulusMap, a_round_annulus_maps_to_itself_with_second_order)
{
    expect_second_order(1e-4, [](const CircleDomain& annulus) {
        const RingSample sample(annulus);
        const double error = distance_up_to_rotation(sample.map.positions, sample.domain.points);
        EXPECT_NEAR(sample.map.inner_radius, 0.3, error + 1e-12);
        return error;
    });
}

TEST(AnnulusMap, the_module_is_that_of_the_domain_under_every_conformal_lift)
{
    // Two circles with inversive distance I bound an annulus of radius exp(-arccosh I).
    for (const Lift kind : {Lift::plane, Lift::polynomial, Lift::sphere, Lift::enneper}) {
        double first = 0.0, last = 0.0;
        for (const Index faces : {1000, 16000}) {
            const RingSample sample(eccentric_annulus(faces), kind);
            const double module = std::acosh(inversive_distance(sample.domain.circles[0], sample.domain.circles[1]));
            last = std::abs(-std::log(sample.map.inner_radius) / module - 1.0);
            EXPECT_NEAR(-std::log(sample.map.inner_radius), two_pi / sample.map.lambda, 1e-14);
            if (first == 0.0) first = last;
        }
        EXPECT_LT(last, 1e-3) << to_string(kind);
        EXPECT_GT(std::log2(first / last), 1.8 * 2.0) << to_string(kind);
    }
}

TEST(AnnulusMap, the_map_is_the_moebius_map_that_centres_the_inner_circle)
{
    const RingSample sample(eccentric_annulus(16000), Lift::polynomial);
    const VectorXcd expected = center_circle(sample.domain.circles[1])(sample.domain.points);
    EXPECT_LT(distance_up_to_rotation(sample.map.positions, expected), 1e-3);
    for (const Index v : sample.domain.loops[0]) EXPECT_NEAR(std::abs(sample.map.positions[v]), 1.0, 1e-14);
    for (const Index v : sample.domain.loops[1])
        EXPECT_NEAR(std::abs(sample.map.positions[v]), sample.map.inner_radius, 1e-14);
}

TEST(AnnulusMap, no_triangle_is_flipped)
{
    const RingSample sample(eccentric_annulus(4000), Lift::enneper);
    for (Eigen::Index f = 0; f < sample.domain.triangles.rows(); ++f) {
        const Complex a = sample.map.positions[sample.domain.triangles(f, 0)];
        EXPECT_GT(std::imag(std::conj(sample.map.positions[sample.domain.triangles(f, 1)] - a) *
                            (sample.map.positions[sample.domain.triangles(f, 2)] - a)),
                  0.0);
    }
}

TEST(AnnulusMap, the_unit_of_length_changes_nothing)
{
    const RingSample sample(eccentric_annulus(800), Lift::enneper);
    for (const double scale : {1e-8, 1e8}) {
        const RingSample scaled(eccentric_annulus(800), Lift::enneper, scale);
        EXPECT_LT((scaled.map.positions - sample.map.positions).cwiseAbs().maxCoeff(), 1e-11);
    }
}

TEST(AnnulusMap, vertices_of_no_face_are_passed_over)
{
    const CircleDomain domain = eccentric_annulus(800);
    const Index n = static_cast<Index>(domain.points.size());
    const EdgeLengths lengths = edge_lengths(lift(domain.points, Lift::plane), domain.triangles);
    const AnnulusMap plain = annulus_map(domain.triangles, lengths, n, domain.loops[0], domain.loops[1]);
    const AnnulusMap more = annulus_map(domain.triangles, lengths, n + 3, domain.loops[0], domain.loops[1]);
    EXPECT_LT((more.positions.head(n) - plain.positions).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(more.positions.tail(3), VectorXcd::Zero(3));
}

TEST(AnnulusMap, loops_that_are_not_joined_are_refused)
{
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 3, 4, 5;
    EXPECT_THROW(annulus_map(triangles, EdgeLengths::Ones(2, 3), 6, {0, 1, 2}, {3, 4, 5}), TopologyError);
}
