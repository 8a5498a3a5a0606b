#include "foldover/face_energy.h"
#include "foldover/foldover_free.h"

#include <Eigen/Dense>
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
    EXPECT_TRUE(minimize_foldover_free(problem, {}).foldover_free);
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
    EXPECT_TRUE(minimize_foldover_free(problem, {}).foldover_free);
    EXPECT_NEAR((problem.points.row(1) - Eigen::RowVector2d(0.5, 0.0)).norm(), 0.5, 1e-14);
    EXPECT_LT((problem.points.row(1) - Eigen::RowVector2d(1.0, 0.0)).norm(), 0.1);
}

TEST(FoldoverFree, what_cannot_be_unfolded_is_not_said_to_be)
{
    FoldoverProblem problem = hexagon({0.0, 0.0});
    problem.points.row(1).swap(problem.points.row(4));
    problem.mobility[0] = FoldoverProblem::Mobility::free;
    EXPECT_FALSE(minimize_foldover_free(problem, {}).foldover_free);
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

TEST(FoldoverFree, a_face_has_the_gradient_and_the_positive_part_of_the_hessian_of_its_energy)
{
    Eigen::Matrix2d wanted;
    wanted << 1.0, 0.3, 0.0, 0.8;
    const WantedShape shape(wanted);
    using Corners = Eigen::Matrix<double, 6, 1>;
    Corners upright, folded, similar;
    upright << 0.1, 0.2, 1.3, 0.1, 0.6, 0.9;
    folded << 0.1, 0.2, 1.3, 0.1, 0.6, -0.5;
    similar << 0.0, 0.0, 0.0, 2.0, -1.6, 0.6;
    for (const FaceEnergy& energy : {FaceEnergy{1.0 / 128.0, 1.0, 0.0, 0.3}, FaceEnergy{0.0, 3.0, 0.01, 1e-3},
                                     FaceEnergy{0.0, 3.0, 0.01, 1e-3, 0.2}})
        for (const Corners& at : {upright, folded, similar}) {
            if (energy.power != 1.0 && at == folded) continue;  // of the order of 1e18
            const auto map = [&](const Corners& x) {
                return shape.map_to({x[2] - x[0], x[3] - x[1]}, {x[4] - x[0], x[5] - x[1]});
            };
            const auto gradient = [&](const Corners& x) {
                const FaceDerivatives face = energy.derivatives(map(x), 0.1, 2.0, shape);
                Corners g;
                for (int k = 0; k < 3; ++k) g.segment<2>(2 * k) << face.gradient[k].real(), face.gradient[k].imag();
                return g;
            };
            constexpr double step = 1e-6;
            Corners slope;
            Eigen::Matrix<double, 6, 6> bend, positive;
            for (int i = 0; i < 6; ++i) {
                const Corners there = at + step * Corners::Unit(i), back = at - step * Corners::Unit(i);
                slope[i] = (energy(map(there), 0.1) - energy(map(back), 0.1)) / step;
                bend.col(i) = (gradient(there) - gradient(back)) / (2.0 * step);
            }
            const FaceDerivatives face = energy.derivatives(map(at), 0.1, 2.0, shape);
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l) positive.block<2, 2>(2 * k, 2 * l) = face.block(k, l, shape);
            // The positive part is that in the map's entries, not in the corners: both agree where nothing is negative.
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (bend + bend.transpose()));
            const double size = eigen.eigenvalues().cwiseAbs().maxCoeff();
            EXPECT_LT((slope - gradient(at)).norm(), 1e-6 * (1.0 + slope.norm()));
            EXPECT_NEAR(face.term, 2.0 * energy(map(at), 0.1), 1e-12 * face.term);
            EXPECT_LT((positive - positive.transpose()).norm(), 1e-12 * size);
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> kept(positive), added(positive - bend);
            EXPECT_GT(kept.eigenvalues().minCoeff(), -1e-9 * size);
            EXPECT_GT(added.eigenvalues().minCoeff(), -1e-6 * size);
            if (eigen.eigenvalues().minCoeff() > -1e-7 * size) {
                EXPECT_LT((positive - bend).norm(), 1e-6 * size);
            }
        }
}
