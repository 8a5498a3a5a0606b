#include "foldover/foldover_free.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;

namespace {

/// A fan of six faces round vertex 0, equilateral ones wanted.
FoldoverProblem hexagon(Complex middle)
{
    FoldoverProblem problem;
    problem.points.resize(7, 2);
    problem.points.row(0) << middle.real(), middle.imag();
    problem.triangles.resize(6, 3);
    Eigen::Matrix2d equilateral;
    equilateral << 1.0, 0.5, 0.0, std::sqrt(0.75);
    for (Index i = 0; i < 6; ++i) {
        const Complex corner = std::polar(1.0, i * std::numbers::pi / 3.0);
        problem.points.row(i + 1) << corner.real(), corner.imag();
        problem.triangles.row(i) << 0, i + 1, (i + 1) % 6 + 1;
        problem.reference.push_back(equilateral);
    }
    problem.floor = VectorXd::Zero(6);
    problem.mobility.assign(7, FoldoverProblem::Mobility::held);
    problem.circles.resize(7);
    return problem;
}

}  // namespace

TEST(FoldoverFree, a_vertex_far_outside_its_ring_comes_back_to_the_middle)
{
    FoldoverProblem problem = hexagon({3.0, 0.4});
    problem.mobility[0] = FoldoverProblem::Mobility::free;
    const PlanarPoints before = problem.points;
    EXPECT_TRUE(minimize_foldover_free(problem, {}));
    EXPECT_LT(problem.points.row(0).norm(), 1e-2);
    EXPECT_EQ((problem.points.bottomRows(6) - before.bottomRows(6)).cwiseAbs().maxCoeff(), 0.0);
}

TEST(FoldoverFree, a_sliding_vertex_stays_on_its_circle)
{
    FoldoverProblem problem = hexagon({0.0, 0.0});
    problem.mobility[1] = FoldoverProblem::Mobility::sliding;
    problem.circles[1] = Circle{{0.5, 0.0}, 0.5};
    problem.points.row(1) << 0.5, 0.5;  // too near to its neighbour; (1, 0) makes the hexagon even
    problem.points.row(2) << 0.5, std::sqrt(0.75);
    EXPECT_TRUE(minimize_foldover_free(problem, {}));
    EXPECT_NEAR((problem.points.row(1) - Eigen::RowVector2d(0.5, 0.0)).norm(), 0.5, 1e-14);
    EXPECT_LT((problem.points.row(1) - Eigen::RowVector2d(1.0, 0.0)).norm(), 0.1);
}

TEST(FoldoverFree, what_cannot_be_unfolded_is_not_said_to_be)
{
    FoldoverProblem problem = hexagon({0.0, 0.0});
    problem.points.row(1).swap(problem.points.row(4));
    problem.mobility[0] = FoldoverProblem::Mobility::free;
    EXPECT_FALSE(minimize_foldover_free(problem, {}));
    EXPECT_TRUE(problem.points.allFinite());
}

TEST(FoldoverFree, cancel_is_answered)
{
    FoldoverProblem problem = hexagon({3.0, 0.4});
    problem.mobility[0] = FoldoverProblem::Mobility::free;
    CancelToken token;
    token.cancel();
    EXPECT_THROW(minimize_foldover_free(problem, ExecutionContext({}, token)), Cancelled);
}
