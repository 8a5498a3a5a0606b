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

/// The cost of the best assignment by shortest augmenting paths in O(n^3) [Jonker and Volgenant 1987], dense and plain.
double reference_cost(const MatrixXd& cost)
{
    constexpr int nobody = -1;
    const int n = static_cast<int>(cost.rows());
    VectorXd row_price = VectorXd::Zero(n), column_price = VectorXd::Zero(n);
    std::vector<int> row_of(n, nobody);
    for (int first = 0; first < n; ++first) {
        VectorXd distance = VectorXd::Constant(n, std::numeric_limits<double>::infinity());
        std::vector<int> before(n, nobody);
        std::vector<char> done(n, 0);
        int row = first, column = nobody, last = nobody;
        double reached = 0.0;
        do {
            for (int j = 0; j < n; ++j) {
                const double way = reached + cost(row, j) - row_price[row] - column_price[j];
                if (!done[j] && way < distance[j]) {
                    distance[j] = way;
                    before[j] = last;
                }
            }
            column = nobody;
            for (int j = 0; j < n; ++j)
                if (!done[j] && (column == nobody || distance[j] < distance[column])) column = j;
            done[column] = 1;
            reached = distance[column];
            last = column;
            row = row_of[column];
        } while (row != nobody);
        row_price[first] += reached;
        for (int j = 0; j < n; ++j)
            if (done[j]) {
                column_price[j] += distance[j] - reached;
                if (row_of[j] != nobody) row_price[row_of[j]] += reached - distance[j];
            }
        for (int j = column; j != nobody; j = before[j]) row_of[j] = before[j] == nobody ? first : row_of[before[j]];
    }
    double sum = 0.0;
    for (int j = 0; j < n; ++j) sum += cost(row_of[j], j);
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

// More rows than the few pairs that each starts with, and costs that make the cheap ones wrong: the prices must find
// the others.
TEST(Assignment, costs_as_little_as_a_dense_method_of_another_kind)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const int n : {17, 40, 150}) {
        const VectorXd a = VectorXd::NullaryExpr(n, [&] { return uniform(random); });
        const VectorXd b = VectorXd::NullaryExpr(n, [&] { return uniform(random); });
        const MatrixXd noise = MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
        for (const MatrixXd& cost :
             {noise, MatrixXd(a * b.transpose()), MatrixXd(a * b.transpose() + 1e-3 * noise),
              MatrixXd((a.replicate(1, n) + b.transpose().replicate(n, 1)).array() + 1e-6 * noise.array()),
              MatrixXd((noise.array() < 0.5).cast<double>()), MatrixXd(1e300 * noise.array() - 5e299),
              MatrixXd(MatrixXd::Constant(n, n, 7.0))}) {
            const std::vector<int> found = least_cost_assignment(cost);
            std::vector<int> order(n);
            std::iota(order.begin(), order.end(), 0);
            EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), order.begin()));
            EXPECT_NEAR(cost_of(cost, found), reference_cost(cost),
                        1e-10 * n * (cost.maxCoeff() - cost.minCoeff() + 1e-300));
        }
    }
}

TEST(Assignment, of_nobody_is_empty) { EXPECT_TRUE(least_cost_assignment(MatrixXd(0, 0)).empty()); }

TEST(Assignment, can_be_cancelled)
{
    CancelToken token;
    token.cancel();
    EXPECT_THROW(least_cost_assignment(MatrixXd::Random(5, 5), ExecutionContext({}, token)), Cancelled);
}
