#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "iteration/koebe_condensed.h"
#include "linear/filled_laplacian.h"
#include "surface/laplacian.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

struct KoebeRun {
    std::vector<Circle> circles;
    KoebeOutcome outcome;
};

/// The iteration with a Sigma for boundaries of up to so many vertices.
KoebeRun run(const CircleDomain& domain, const Vertices& surface, Method method, std::size_t most_condensed,
             bool gauss_seidel = false)
{
    const EdgeLengths lengths = edge_lengths(surface, domain.triangles);
    const Index count = static_cast<Index>(surface.rows());
    const SparseMatrix laplacian = cotan_laplacian(domain.triangles, half_cotangents(lengths), count);
    std::vector<VectorXd> edges;
    for (const VertexLoop& loop : domain.loops) {
        VectorXd length(loop.size());
        for (std::size_t b = 0; b < loop.size(); ++b)
            length[b] = (surface.row(loop[(b + 1) % loop.size()]) - surface.row(loop[b])).norm();
        edges.push_back(length);
    }
    IterationOptions options;
    options.method = method;
    options.tolerance = 1e-9;
    options.gauss_seidel = gauss_seidel;
    const FactoredSurface condensed = condense(laplacian, domain.loops, options, most_condensed);
    EXPECT_EQ(condensed.dense != nullptr, domain.loops.size() == 1 || most_condensed > 0);
    ExecutionContext context;
    KoebeRun result;
    result.outcome = koebe_condensed(laplacian, condensed, domain.loops, edges,
                                     vertex_areas(domain.triangles, lengths, count), options, context);
    for (const VectorXcd& loop : result.outcome.loops) result.circles.push_back(fit_circle_least_squares(loop));
    return result;
}

std::vector<Circle> ten_circles()
{
    std::vector<Circle> circles{Circle{}};
    for (int k = 0; k < 6; ++k) circles.push_back({std::polar(0.65, 1.1 * k), 0.12 + 0.02 * k});
    for (int k = 0; k < 3; ++k) circles.push_back({std::polar(0.25, 2.1 * k + 0.4), 0.1});
    return circles;
}

}  // namespace

TEST(SparseState, finds_the_circles_that_the_dense_state_finds)
{
    const CircleDomain domain = make_circle_domain(ten_circles(), 4000);
    for (const Lift kind : {Lift::polynomial, Lift::enneper}) {
        const Vertices surface = lift(domain.points, kind);
        const KoebeRun dense = run(domain, surface, Method::gk, 100000), sparse = run(domain, surface, Method::gk, 0);
        ASSERT_TRUE(dense.outcome.converged && sparse.outcome.converged);
        EXPECT_LT(inversive_distance_error(sparse.circles, dense.circles), 1e-9) << to_string(kind);
        EXPECT_NEAR(sparse.outcome.history.back().mean_roundness.all.paper,
                    dense.outcome.history.back().mean_roundness.all.paper, 1e-10);
    }
}

TEST(SparseState, a_hole_whose_disk_lies_on_nodes_is_where_the_dense_state_finds_it)
{
    const CircleDomain domain = make_circle_domain({Circle{}, {0.1, 0.84}, {-0.87, 0.06}}, 22000);
    ASSERT_FALSE(FilledLaplacian::nodes(static_cast<Index>(domain.loops[1].size())).empty());
    for (const Lift kind : {Lift::plane, Lift::enneper}) {
        const Vertices surface = lift(domain.points, kind);
        const KoebeRun dense = run(domain, surface, Method::gk, 100000), nodes = run(domain, surface, Method::gk, 0);
        ASSERT_TRUE(dense.outcome.converged && nodes.outcome.converged);
        const double error = inversive_distance_error(dense.circles, domain.circles);
        EXPECT_LT(inversive_distance_error(nodes.circles, dense.circles), 0.1 * error) << to_string(kind);
        EXPECT_LT(inversive_distance_error(nodes.circles, domain.circles), 1.2 * error) << to_string(kind);
    }
}

TEST(SparseState, all_loops_at_once_find_the_known_circles)
{
    std::vector<double> errors;
    for (const Index faces : {2000, 8000}) {
        const CircleDomain domain = make_circle_domain(ten_circles(), faces);
        errors.push_back(inversive_distance_error(
            run(domain, lift(domain.points, Lift::enneper), Method::gk, 0).circles, domain.circles));
    }
    EXPECT_LT(errors[1], 1e-3);
    EXPECT_LT(errors[1], errors[0] / 3.0);
}

TEST(SparseState, both_methods_are_one_when_all_loops_are_opened_at_once)
{
    const CircleDomain domain = make_circle_domain(ten_circles(), 2000);
    const Vertices surface = lift(domain.points, Lift::enneper);
    const KoebeRun gk = run(domain, surface, Method::gk, 100000), ck = run(domain, surface, Method::ck, 100000);
    EXPECT_EQ(gk.outcome.sweeps, ck.outcome.sweeps);
    EXPECT_EQ(gk.outcome.steps * 2, ck.outcome.steps);
    EXPECT_EQ(inversive_distance_error(gk.circles, ck.circles), 0.0);
}

TEST(CondensedState, steps_gauss_seidel_find_the_same_circles_and_gk_in_half_the_steps_of_ck)
{
    const CircleDomain domain = make_circle_domain(ten_circles(), 4000);
    const Vertices surface = lift(domain.points, Lift::enneper);
    const KoebeRun at_once = run(domain, surface, Method::gk, 100000);
    const KoebeRun gk = run(domain, surface, Method::gk, 100000, true),
                   ck = run(domain, surface, Method::ck, 100000, true);
    ASSERT_TRUE(at_once.outcome.converged && gk.outcome.converged && ck.outcome.converged);
    // The limits differ by the discretization, of which the next test tells the size.
    EXPECT_LT(inversive_distance_error(gk.circles, at_once.circles), 1e-3);
    EXPECT_LT(inversive_distance_error(ck.circles, at_once.circles), 1e-3);
    EXPECT_GT(inversive_distance_error(gk.circles, ck.circles), 0.0);  // they are not one iteration
    // Each step has its own change, and the next one sees it.
    EXPECT_NE(gk.outcome.history[0].change, gk.outcome.history[1].change);
    EXPECT_EQ(at_once.outcome.history[0].change, at_once.outcome.history[1].change);
    EXPECT_LT(gk.outcome.steps, 0.7 * ck.outcome.steps);
}

TEST(SparseState, one_and_two_loops_are_exact_in_no_and_one_step)
{
    const CircleDomain disk = make_circle_domain({Circle{}}, 1000);
    const KoebeRun one = run(disk, lift(disk.points, Lift::enneper), Method::gk, 0);
    EXPECT_TRUE(one.outcome.converged);
    EXPECT_EQ(one.outcome.steps, 0);
    const CircleDomain annulus = make_round_annulus(0.4, 80, 20);
    const Vertices surface = lift(annulus.points, Lift::plane);
    const KoebeRun dense = run(annulus, surface, Method::gk, 100000), sparse = run(annulus, surface, Method::gk, 0);
    EXPECT_EQ(sparse.outcome.steps, 1);
    EXPECT_NEAR(inversive_distance(sparse.circles[0], sparse.circles[1]) /
                    inversive_distance(dense.circles[0], dense.circles[1]),
                1.0, 1e-8);
}
