#include "linear/sparse_cholesky.h"

#include "core/errors.h"
#include "linear/factor/row_groups.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>

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
        const SparseCholesky cholesky(matrix, last);
        const std::vector<MatrixXd> blocks = cholesky.inverse_blocks(cliques);
        ASSERT_EQ(blocks.size(), cliques.size());
        for (std::size_t k = 0; k < cliques.size(); ++k)
            EXPECT_LT((blocks[k] - MatrixXd(inverse(cliques[k], cliques[k]))).cwiseAbs().maxCoeff(), 1e-12) << k;
    }
}

TEST(SparseCholesky, rows_with_one_pattern_are_analyzed_as_one)
{
    const SparseMatrix grid = grid_with_cliques(cliques);
    std::vector<Index> first{0};  // each row of the grid becomes one, two or three rows
    for (Index v = 0; v < side * side; ++v) first.push_back(first.back() + 1 + v * v % 3);
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index v = 0; v < side * side; ++v)
        for (SparseMatrix::InnerIterator it(grid, v); it; ++it)
            for (Index c = first[v]; c < first[v + 1]; ++c)
                for (Index r = first[it.row()]; r < first[it.row() + 1]; ++r)
                    entries.emplace_back(r, c, r == c ? 3.0 * it.value() : 0.1 * it.value());
    SparseMatrix matrix(first.back(), first.back());
    matrix.setFromTriplets(entries.begin(), entries.end());
    EXPECT_EQ(detail::row_groups(matrix).first, first);
    EXPECT_EQ(detail::row_groups(matrix.triangularView<Eigen::Lower>()).first, first);
    EXPECT_EQ(detail::row_groups(grid).count(), side * side);
    EXPECT_TRUE(detail::pattern_of_groups(matrix, {first}).isApprox(0.0 * grid));
    EXPECT_EQ(detail::pattern_of_groups(matrix, {first}).nonZeros(), (grid.nonZeros() + side * side) / 2);

    const VectorXd f = VectorXd::LinSpaced(matrix.rows(), 0.0, 40.0).array().sin();
    for (const SparseMatrix& given : {matrix, SparseMatrix(matrix.triangularView<Eigen::Lower>())}) {
        SparseCholesky cholesky(given);
        EXPECT_LT((matrix * cholesky.solve(f) - f).cwiseAbs().maxCoeff(), 1e-11);
        cholesky.refactorize(given);
        EXPECT_LT((matrix * cholesky.solve(f) - f).cwiseAbs().maxCoeff(), 1e-11);
    }
}

TEST(SparseCholesky, neighbours_that_other_rows_tell_apart_are_no_group)
{
    MatrixXd dense = 4.0 * MatrixXd::Identity(5, 5);
    for (const auto& [r, c] : {std::pair{1, 0}, {3, 2}, {4, 2}, {4, 3}}) dense(r, c) = dense(c, r) = 1.0;
    EXPECT_EQ(detail::row_groups(dense.sparseView()).first, (std::vector<Index>{0, 2, 5}));
    dense(3, 0) = dense(0, 3) = 1.0;  // of 2, 3 and 4 only 3 touches 0, and of 0 and 1 only 0 touches 3
    EXPECT_EQ(detail::row_groups(dense.sparseView()).first, (std::vector<Index>{0, 1, 2, 3, 4, 5}));
}

TEST(SparseCholesky, rows_kept_last_give_their_schur_complement_and_extension)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    const std::vector<Index>& last = cliques[0];
    const SparseCholesky cholesky(matrix, last);
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

namespace {

/// Symmetric blocks on the cliques that keep the grid's matrix positive definite.
std::vector<MatrixXd> blocks_on_cliques(double scale)
{
    std::vector<MatrixXd> result;
    for (const std::vector<Index>& clique : cliques) {
        const VectorXd x = VectorXd::LinSpaced(static_cast<Eigen::Index>(clique.size()), 0.3, 1.7);
        result.push_back(scale * (x * x.transpose() + MatrixXd::Identity(x.size(), x.size())));
    }
    return result;
}

MatrixXd with_blocks(const SparseMatrix& matrix, const std::vector<MatrixXd>& blocks)
{
    MatrixXd result(matrix);
    for (std::size_t k = 0; k < cliques.size(); ++k)
        for (std::size_t i = 0; i < cliques[k].size(); ++i)
            for (std::size_t j = 0; j < cliques[k].size(); ++j) result(cliques[k][i], cliques[k][j]) += blocks[k](i, j);
    return result;
}

}  // namespace

TEST(SparseCholesky, renewed_factor_is_that_of_the_other_matrix)
{
    const SparseMatrix first = grid_with_cliques(cliques);
    const MatrixXd f = MatrixXd::Random(first.rows(), 2);
    for (const std::vector<Index>& last : {std::vector<Index>{}, cliques[0]}) {
        SparseCholesky cholesky(first, last);
        SparseMatrix other = first;
        const auto expect_factor_of_other = [&] {
            cholesky.refactorize(other);
            EXPECT_LT((other * cholesky.solve(f) - f).cwiseAbs().maxCoeff(), 1e-11);
            const SparseCholesky fresh(other, last);
            EXPECT_LT((cholesky.last_schur() - fresh.last_schur()).norm(), 1e-12 * first.norm());
        };
        for (const double scale : {3.0, 0.2}) {
            other = scale * first;
            for (Index v = 0; v < static_cast<Index>(other.rows()); ++v) other.coeffRef(v, v) += 0.1 * (v % 7);
            expect_factor_of_other();
        }
        other = SparseMatrix(other.triangularView<Eigen::Lower>());
        cholesky.refactorize(other);
        EXPECT_LT((other.selfadjointView<Eigen::Lower>() * cholesky.solve(f) - f).cwiseAbs().maxCoeff(), 1e-11);
        // Fewer entries: those that are not there count as 0.
        other = first;
        other.prune([](Index row, Index column, double) { return row == column || std::abs(row - column) == side; });
        expect_factor_of_other();
        other = first;
        expect_factor_of_other();
    }
}

TEST(SparseCholesky, renewal_by_a_matrix_that_is_not_positive_definite_is_told_and_forgotten)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    SparseCholesky cholesky(matrix, cliques[0]);
    SparseMatrix indefinite = matrix;
    indefinite.coeffRef(77, 77) = -1.0;
    EXPECT_THROW(cholesky.refactorize(indefinite), SolverError);
    cholesky.refactorize(matrix);
    const MatrixXd f = MatrixXd::Random(matrix.rows(), 1);
    EXPECT_LT((matrix * cholesky.solve(f) - f).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(SparseCholesky, blocks_that_change_leave_nothing_of_the_ones_before)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    const MatrixXd f = MatrixXd::Random(matrix.rows(), 2);
    for (const bool by_fill : {false, true}) {
        SparseCholesky cholesky(matrix, cliques[0], cliques, by_fill);
        for (const double scale : {0.5, 100.0, 0.0}) {
            const std::vector<MatrixXd> blocks = blocks_on_cliques(scale);
            cholesky.refactorize(blocks);
            const MatrixXd inverse = with_blocks(matrix, blocks).inverse();
            EXPECT_LT((cholesky.solve(f) - inverse * f).cwiseAbs().maxCoeff(), 1e-11) << scale;
            const std::vector<MatrixXd> selected = cholesky.inverse_blocks(cliques);
            for (std::size_t k = 0; k < cliques.size(); ++k)
                EXPECT_LT((selected[k] - MatrixXd(inverse(cliques[k], cliques[k]))).cwiseAbs().maxCoeff(), 1e-12)
                    << scale;
        }
    }
}

TEST(SparseCholesky, a_change_that_is_not_positive_definite_is_told_and_forgotten)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    SparseCholesky cholesky(matrix, {}, cliques, false);
    EXPECT_THROW(cholesky.refactorize(blocks_on_cliques(-100.0)), SolverError);
    const std::vector<MatrixXd> blocks = blocks_on_cliques(1.0);
    cholesky.refactorize(blocks);
    const MatrixXd f = MatrixXd::Random(matrix.rows(), 1);
    EXPECT_LT((with_blocks(matrix, blocks) * cholesky.solve(f) - f).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(SparseCholesky, rows_that_are_wanted_are_those_of_the_whole_solution)
{
    const SparseMatrix matrix = grid_with_cliques(cliques);
    const std::vector<Index> wanted{528, 0, 77, 300};
    const SparseCholesky cholesky(matrix, cliques[0]);
    for (const Index columns : {1, 2, 3}) {
        MatrixXd f = MatrixXd::Zero(matrix.rows(), columns);
        f.row(10).setLinSpaced(1.0, 2.0);
        f.row(251).setConstant(-1.0);
        EXPECT_LT((cholesky.solve_for(wanted, f) - cholesky.solve(f)(wanted, Eigen::all)).cwiseAbs().maxCoeff(), 1e-13);
        const MatrixXd values = MatrixXd::Random(static_cast<Eigen::Index>(cliques[0].size()), columns);
        const MatrixXd whole = cholesky.extend(values);
        EXPECT_LT((cholesky.extend_to(wanted, values) - whole(wanted, Eigen::all)).cwiseAbs().maxCoeff(), 1e-13);
    }
}
