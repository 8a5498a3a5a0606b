#include "shape/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

using namespace koebe;

namespace {

double cost_of(const MatrixXd& cost, const std::vector<int>& chosen)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < chosen.size(); ++i) sum += cost(static_cast<Eigen::Index>(i), chosen[i]);
    return sum;
}

}  // namespace

TEST(Assignment, costs_as_little_as_the_best_of_all_permutations)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int n = 1; n <= 6; ++n)
        for (int trial = 0; trial < 20; ++trial) {
            const MatrixXd cost = MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
            std::vector<int> order(n);
            std::iota(order.begin(), order.end(), 0);
            double least = std::numeric_limits<double>::infinity();
            do least = std::min(least, cost_of(cost, order));
            while (std::next_permutation(order.begin(), order.end()));
            const std::vector<int> found = least_cost_assignment(cost);
            EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), order.begin()));
            EXPECT_NEAR(cost_of(cost, found), least, 1e-12);
        }
}

TEST(Assignment, finds_a_hidden_permutation_of_many_points)
{
    const int n = 200;
    const VectorXcd points = VectorXcd::Random(n);
    const auto hidden = [](int i) { return (37 * i + 11) % n; };
    MatrixXd cost(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) cost(i, hidden(j)) = std::norm(points[i] - points[j] - Complex(1e-4, 0.0));
    const std::vector<int> found = least_cost_assignment(cost);
    for (int i = 0; i < n; ++i) EXPECT_EQ(found[i], hidden(i));
}
