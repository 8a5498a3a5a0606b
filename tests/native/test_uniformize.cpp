#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "pipeline/uniformize.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace koebe;
using namespace koebe::test;

namespace {

UniformizeResult run(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options = {})
{
    ExecutionContext context;
    return uniformize(vertices, triangles, options, context);
}

/// Found circles in the order of the domain's loops.
std::vector<Circle> matched_circles(const UniformizeResult& result, const CircleDomain& domain)
{
    std::vector<Circle> circles;
    for (const VertexLoop& loop : domain.loops)
        for (const LoopReport& report : result.loops)
            if (std::find(report.vertices.begin(), report.vertices.end(), loop.front()) != report.vertices.end())
                circles.push_back(report.circle);
    return circles;
}

double circle_error(const CircleDomain& domain, Lift kind, const UniformizeOptions& options)
{
    UniformizeOptions with_outer = options;
    with_outer.outer = OuterLoop::vertex;
    with_outer.outer_vertex = domain.loops[0].front();
    const UniformizeResult result = run(lift(domain.points, kind), domain.triangles, with_outer);
    EXPECT_TRUE(result.converged);
    EXPECT_TRUE(result.distortion.flipped.empty());
    return inversive_distance_error(matched_circles(result, domain), domain.circles);
}

void expect_on_circles(const UniformizeResult& result, double tolerance)
{
    for (const LoopReport& loop : result.loops) {
        EXPECT_TRUE(loop.off_circle.empty());
        for (const Index v : loop.vertices) {
            const Complex z(result.uv(v, 0), result.uv(v, 1));
            EXPECT_NEAR(std::abs(z - loop.circle.center), loop.circle.radius, tolerance);
        }
    }
}

struct ExactCase {
    Lift lift;
    Engine engine;
    Index faces;
    double limit;  ///< relative error of the inversive distances at so many faces
};

class ExactDomain : public testing::TestWithParam<ExactCase> {};

TEST_P(ExactDomain, circles_converge_with_second_order)
{
    const auto [kind, engine, finest, limit] = GetParam();
    UniformizeOptions options;
    options.engine = engine;
    double first = 0.0, last = 0.0;
    for (const Index faces : {Index{1000}, finest}) {
        last = circle_error(make_circle_domain(five_circles(), faces), kind, options);
        if (first == 0.0) first = last;
    }
    const double order = std::log(first / last) / std::log(std::sqrt(1e-3 * finest));
    RecordProperty("error", std::to_string(last));
    RecordProperty("order", std::to_string(order));
    EXPECT_GE(order, 1.8) << first << " -> " << last;
    EXPECT_LE(last, limit);
}

INSTANTIATE_TEST_SUITE_P(Condensed, ExactDomain,
                         testing::Values(ExactCase{Lift::polynomial, Engine::condensed, 36000, 2e-4},
                                         ExactCase{Lift::sphere, Engine::condensed, 36000, 2e-4},
                                         ExactCase{Lift::enneper, Engine::condensed, 36000, 3e-5}),
                         [](const auto& info) { return to_string(info.param.lift); });
INSTANTIATE_TEST_SUITE_P(Mesh, ExactDomain,
                         testing::Values(ExactCase{Lift::polynomial, Engine::mesh, 16000, 1e-3},
                                         ExactCase{Lift::sphere, Engine::mesh, 16000, 1e-3},
                                         ExactCase{Lift::enneper, Engine::mesh, 16000, 1e-3}),
                         [](const auto& info) { return to_string(info.param.lift); });

}  // namespace

TEST(Uniformize, a_circle_domain_keeps_its_circles)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 4000);
    EXPECT_LT(circle_error(domain, Lift::plane, {}), 1e-3);
}

TEST(Uniformize, loops_lie_on_their_circles_and_nothing_is_flipped)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 4000);
    for (const Lift kind : curved_lifts) {
        const UniformizeResult result = run(lift(domain.points, kind), domain.triangles);
        expect_on_circles(result, 1e-13);
        EXPECT_TRUE(result.distortion.flipped.empty());
        EXPECT_LT(result.distortion.angle_error_deg.mean, 1.0);
        EXPECT_EQ(result.loops.size(), 5u);
        EXPECT_NEAR(std::abs(result.loops[0].circle.center), 0.0, 0.0);
        EXPECT_EQ(result.loops[0].circle.radius, 1.0);
    }
}

TEST(Uniformize, a_round_annulus_is_concentric_with_its_own_radius)
{
    const CircleDomain domain = make_round_annulus(0.4, 120, 30);
    const UniformizeResult result = run(lift(domain.points, Lift::polynomial), domain.triangles);
    ASSERT_EQ(result.loops.size(), 2u);
    EXPECT_NEAR(std::abs(result.loops[1].circle.center), 0.0, 1e-13);
    EXPECT_NEAR(result.loops[1].circle.radius, 0.4, 2e-3);
    expect_on_circles(result, 1e-13);
}

TEST(Uniformize, the_disk_is_its_own_riemann_map)
{
    const CircleDomain domain = make_circle_domain({Circle{}}, 4000);
    const UniformizeResult result = run(lift(domain.points, Lift::enneper), domain.triangles);
    ASSERT_EQ(result.loops.size(), 1u);
    EXPECT_LT(result.distortion.angle_error_deg.mean, 0.7);
    EXPECT_TRUE(result.distortion.flipped.empty());
    // Up to an automorphism the map is the identity: cross ratios of boundary points agree.
    const auto cross_ratio = [](Complex a, Complex b, Complex c, Complex d) {
        return (a - c) * (b - d) / ((a - d) * (b - c));
    };
    const VertexLoop& loop = domain.loops[0];
    const std::size_t n = loop.size();
    const auto image = [&](std::size_t i) { return Complex(result.uv(loop[i], 0), result.uv(loop[i], 1)); };
    const auto source = [&](std::size_t i) { return domain.points[loop[i]]; };
    const Complex found = cross_ratio(image(0), image(n / 4), image(n / 2), image(3 * n / 4));
    const Complex expected = cross_ratio(source(0), source(n / 4), source(n / 2), source(3 * n / 4));
    EXPECT_LT(std::abs(found / expected - 1.0), 5e-3);
}

TEST(Uniformize, rigid_motions_and_units_change_nothing)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    const Vertices surface = lift(domain.points, Lift::enneper);
    const UniformizeResult expected = run(surface, domain.triangles);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    for (const double scale : {1e-8, 1.0, 1e8}) {
        const Vertices moved = scale * ((surface * turn.transpose()).rowwise() + Eigen::RowVector3d(0.3, -0.2, 0.9));
        const UniformizeResult result = run(moved, domain.triangles);
        EXPECT_LT((result.uv - expected.uv).cwiseAbs().maxCoeff(), 1e-9) << scale;
    }
}

TEST(Uniformize, reruns_are_bit_identical)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 8000);
    const Vertices surface = lift(domain.points, Lift::sphere);
    const UniformizeResult first = run(surface, domain.triangles);
    for (int again = 0; again < 3; ++again)
        EXPECT_EQ((run(surface, domain.triangles).uv - first.uv).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Uniformize, gk_needs_fewer_steps_than_ck_to_the_same_roundness)
{
    std::vector<Circle> circles = five_circles();
    circles.push_back({{0.0, 0.05}, 0.1});
    const CircleDomain domain = make_circle_domain(circles, 4000);
    // Not the sphere: stereographic projection keeps circles round, so that lift has no step to take.
    for (const Lift kind : {Lift::polynomial, Lift::enneper}) {
        UniformizeOptions options;
        const UniformizeResult gk = run(lift(domain.points, kind), domain.triangles, options);
        options.method = Method::ck;
        const UniformizeResult ck = run(lift(domain.points, kind), domain.triangles, options);
        ASSERT_TRUE(gk.converged && ck.converged);
        const double wanted =
            1.2 * std::max(gk.history.back().mean_roundness.all.paper, ck.history.back().mean_roundness.all.paper);
        const auto steps_to = [wanted](const UniformizeResult& result) {
            return std::find_if(result.history.begin(), result.history.end(),
                                [&](const KoebeStep& step) { return step.mean_roundness.all.paper <= wanted; })
                ->step;
        };
        EXPECT_LT(steps_to(gk), steps_to(ck)) << to_string(kind);
        EXPECT_LT(inversive_distance_error(matched_circles(ck, domain), matched_circles(gk, domain)), 1e-3);
    }
}

TEST(Uniformize, a_bound_on_sweeps_is_reported_not_hidden)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    UniformizeOptions options;
    options.max_sweeps = 1;
    options.tolerance = 1e-12;
    const UniformizeResult result = run(lift(domain.points, Lift::enneper), domain.triangles, options);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.sweeps, 1);
    EXPECT_FALSE(result.warnings.empty());
}

TEST(Uniformize, vertices_of_no_face_and_turned_faces_are_said)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Vertices surface = lift(domain.points, Lift::enneper);
    const UniformizeResult expected = run(surface, domain.triangles);
    Vertices with_unused(surface.rows() + 2, 3);
    with_unused << Vertices::Random(2, 3), surface;
    Triangles shifted = domain.triangles.array() + 2;
    std::swap(shifted(5, 0), shifted(5, 1));
    const UniformizeResult result = run(with_unused, shifted);
    EXPECT_LT((result.uv.bottomRows(surface.rows()) - expected.uv).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(result.uv.topRows(2).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(result.warnings.size(), 2u);
}

TEST(Uniformize, progress_never_goes_back_and_cancel_is_answered)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    const Vertices surface = lift(domain.points, Lift::enneper);
    std::vector<double> fractions;
    ExecutionContext watched([&](double fraction, const std::string&) { fractions.push_back(fraction); }, {});
    uniformize(surface, domain.triangles, {}, watched);
    EXPECT_GE(fractions.size(), 6u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1.0);

    for (std::size_t stop = 1; stop < fractions.size(); ++stop) {
        CancelToken token;
        std::size_t calls = 0;
        ExecutionContext cancelled(
            [&](double, const std::string&) {
                if (++calls == stop) token.cancel();
            },
            token);
        EXPECT_THROW(uniformize(surface, domain.triangles, {}, cancelled), Cancelled);
        EXPECT_EQ(calls, stop);
    }
}

TEST(Uniformize, the_outer_loop_can_be_chosen)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    UniformizeOptions options;
    options.outer = OuterLoop::vertex;
    options.outer_vertex = domain.loops[2][1];
    const UniformizeResult result = run(lift(domain.points, Lift::plane), domain.triangles, options);
    EXPECT_EQ(result.loops[0].vertices.size(), domain.loops[2].size());
    EXPECT_LT(inversive_distance_error(matched_circles(result, domain), domain.circles), 1e-2);
    options.outer_vertex = domain.triangles.maxCoeff();
    EXPECT_THROW(run(lift(domain.points, Lift::plane), domain.triangles, options), InputError);
}
