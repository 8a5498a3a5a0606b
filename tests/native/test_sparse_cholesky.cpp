#include "linear/sparse_cholesky.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace koebe;

namespace {

constexpr Index side = 23;

/// The Laplacian of a square grid, positive definite, and cliques of entries 0.01 between far vertices.
SparseMatrix grid_with_cliques(const std::vector<std::vector<Index>>& cliques)
{
    std::vector<Eigen::Triplet<double, Index>> entries;
    const auto edge = [&](Index v, Index w, double weight) {
        entries.emplace_back(v, w, -weight);
        entries.emplace_back(w, v, -weight);
        entries.emplace_back(v, v, weight);
        entries.emplace_back(w, w, weight);
    };
    for (Index y = 0; y < side; ++y)
        for (Index x = 0; x < side; ++x) {
            const Index v = y * side + x;
            entries.emplace_back(v, v, 0.01);
            if (x + 1 < side) edge(v, v + 1, 1.0 + 0.1 * static_cast<double>(x % 3));
            if (y + 1 < side) edge(v, v + side, 1.0);
        }
    for (const std::vector<Index>& clique : cliques)
        for (const Index v : clique)
            for (const Index w : clique)
                if (v < w) edge(v, w, 0.01);
    SparseMatrix result(side * side, side * side);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

const std::vector<std::vector<Index>> cliques{{3, 200, 70, 41, 5}, {528, 100, 300, 17}, {60}, {250, 251, 274, 273}};

}  // namespace

TEST(SparseCholesky, selected_blocks_are_those_of_the_inverse)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    const MatrixXd inverse = MatrixXd(matrix).inverse();
    for (const std::vector<Index>& last : {std::vector<Index>{}, cliques[1]}) {
        const SparseCholesky cholesky(matrix, Ordering::amd, last);
        const std::vector<MatrixXd> blocks = cholesky.inverse_blocks(cliques);
        ASSERT_EQ(blocks.size(), cliques.size());
        for (std::size_t k = 0; k < cliques.size(); ++k)
            EXPECT_LT((blocks[k] - MatrixXd(inverse(cliques[k], cliques[k]))).cwiseAbs().maxCoeff(), 1e-12) << k;
    }
}

TEST(SparseCholesky, sum_of_the_columns_of_a_form_of_the_inverse)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    SparseMatrix b(matrix.rows(), 3);
    b.insert(400, 0) = 2.0;
    b.insert(10, 0) = -1.0;
    b.insert(10, 1) = 1.0;  // cancels in the sum
    b.insert(77, 2) = 3.0;
    b.makeCompressed();
    const MatrixXd form = MatrixXd(b).transpose() * MatrixXd(matrix).inverse() * MatrixXd(b);
    EXPECT_LT((SparseCholesky(matrix).inverse_form_sum(b) - form.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SparseCholesky, rows_kept_last_give_their_schur_complement_and_extension)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    const std::vector<Index>& last = cliques[0];
    const SparseCholesky cholesky(matrix, Ordering::amd, last);
    const MatrixXd schur = MatrixXd(MatrixXd(matrix).inverse()(last, last)).inverse();
    EXPECT_LT((cholesky.last_schur() - schur).cwiseAbs().maxCoeff(), 1e-11);

    const VectorXd values = VectorXd::LinSpaced(static_cast<Eigen::Index>(last.size()), -1.0, 2.0);
    const VectorXd x = cholesky.extend(values);
    EXPECT_EQ(VectorXd(x(last)), values);
    VectorXd residual = matrix * x;
    EXPECT_LT((VectorXd(residual(last)) - schur * values).cwiseAbs().maxCoeff(), 1e-11);
    residual(last).setZero();
    EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-12);
}
