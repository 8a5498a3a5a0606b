#include "linear/kept_factor.h"

#include "core/errors.h"

#include <Eigen/SparseCore>
#include <gtest/gtest.h>

#include <vector>

using namespace koebe;

namespace {

/// The lower triangle of a symmetric matrix of three rows.
SparseMatrix lower(double a, double b, double c, double d)
{
    const std::vector<Eigen::Triplet<double, Index>> entries{{0, 0, a}, {1, 1, b}, {2, 2, c}, {1, 0, d}, {2, 1, d}};
    SparseMatrix matrix(3, 3);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

const VectorXd gradient = Eigen::Vector3d(1.0, -2.0, 0.5);

TEST(KeptFactor, a_kept_pattern_changes_no_bit)
{
    KeptFactor kept, other;
    factored(kept, lower(3.0, 4.0, 5.0, 1.0));
    const SparseMatrix matrix = lower(7.0, 2.0, 9.0, -1.0);
    EXPECT_TRUE(factored(kept, matrix).solve(gradient) == factored(other, matrix).solve(gradient));
    EXPECT_THROW(factored(kept, lower(1.0, 1.0, 1.0, 2.0)), SolverError);
    EXPECT_TRUE(factored(kept, matrix).solve(gradient) == factored(other, matrix).solve(gradient));
}

TEST(NewtonDescent, the_step_of_a_convex_quadratic_ends_at_its_minimum)
{
    KeptFactor kept;
    SparseMatrix hessian = lower(3.0, 4.0, 5.0, 1.0);
    const auto [step, slope] = newton_descent(hessian, gradient, 0.0, kept);
    EXPECT_LT((hessian.selfadjointView<Eigen::Lower>() * step + gradient).norm(), 1e-14);
    EXPECT_EQ(slope, gradient.dot(step));
    EXPECT_LT(slope, 0.0);
}

TEST(NewtonDescent, without_a_minimum_the_step_is_minus_the_gradient_over_the_diagonal)
{
    KeptFactor kept;
    SparseMatrix hessian = lower(1.0, -4.0, 2.0, 3.0);  // -4 becomes 1
    const auto [step, slope] = newton_descent(hessian, gradient, 1.0, kept);
    EXPECT_TRUE(step == VectorXd(Eigen::Vector3d(-0.5, 2.0, -0.125)));
    EXPECT_EQ(slope, gradient.dot(step));
    EXPECT_FALSE(kept);
}

}  // namespace
