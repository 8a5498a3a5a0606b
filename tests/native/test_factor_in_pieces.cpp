// Matrices that are factored in pieces: as one that is factored whole, and bit for bit the same on any number of
// threads. The thread sanitizer looks on in `make test-tsan`.
#include "core/errors.h"
#include "execution/thread_share.h"
#include "linear/dense_spd.h"
#include "linear/factor/analysis.h"
#include "linear/factor/dissection.h"
#include "linear/sparse_cholesky.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace koebe;
using namespace koebe::detail;

namespace {

constexpr Index columns = 40, rows = 31, piece_rows = 150;
constexpr Index never = 1 << 30;

/// Laplacians of grids with diagonals, other weights on every edge. @param count of grids, unconnected
SparseMatrix grid_laplacian(Index count = 1)
{
    std::vector<Eigen::Triplet<double, Index>> entries;
    const auto edge = [&](Index v, Index w) {
        const double weight = 1.0 + 0.5 * std::sin(static_cast<double>(3 * v + 7 * w));
        entries.emplace_back(v, w, -weight);
        entries.emplace_back(w, v, -weight);
        entries.emplace_back(v, v, weight);
        entries.emplace_back(w, w, weight);
    };
    for (Index g = 0; g < count; ++g)
        for (Index y = 0; y < rows; ++y)
            for (Index x = 0; x < columns; ++x) {
                const Index v = g * columns * rows + y * columns + x;
                entries.emplace_back(v, v, 1e-3);
                if (x + 1 < columns) edge(v, v + 1);
                if (y + 1 < rows) edge(v, v + columns);
                if (x + 1 < columns && y + 1 < rows) edge(v, v + columns + 1);
            }
    SparseMatrix result(count * columns * rows, count * columns * rows);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

/// Both short sides, out of order.
std::vector<Index> both_sides()
{
    std::vector<Index> last;
    for (Index y = rows - 1; y >= 0; --y) last.insert(last.end(), {y * columns + columns - 1, y * columns});
    return last;
}

VectorXd some_numbers(Eigen::Index count) { return VectorXd::LinSpaced(count, 0.0, 40.0).array().sin(); }

double difference(const MatrixXd& a, const MatrixXd& b)
{
    return a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff() / std::max(1.0, b.cwiseAbs().maxCoeff());
}

/// Everything that a factor gives.
std::vector<MatrixXd> answers(const SparseCholesky& factor, Index size, const std::vector<Index>& last)
{
    const VectorXd f = some_numbers(size);
    MatrixXd two(size, 2);
    two << f, f.reverse();
    std::vector<MatrixXd> result{factor.solve(two)};
    for (MatrixXd& block : factor.inverse_blocks({{1, 2, columns + 2}, {size - 1}, {501, 502}}))
        result.push_back(block);
    if (last.empty()) return result;
    const auto [values, flux] = factor.solve_inner(f);
    const Eigen::Index count = static_cast<Eigen::Index>(last.size());
    for (MatrixXd more :
         {factor.last_schur(), factor.extend(two.topRows(count)), factor.extend(two.topRows(count), two),
          factor.flux_to_last(two), MatrixXd(values), MatrixXd(flux)})
        result.push_back(std::move(more));
    return result;
}

struct Case {
    const char* name;
    SparseMatrix matrix;
    std::vector<Index> last;
};

std::vector<Case> cases()
{
    std::vector<Case> result{{"alone", grid_laplacian(), {}}, {"both sides last", grid_laplacian(), both_sides()}};
    result.push_back({"two of the same", grid_laplacian(2), {}});
    result.push_back({"three, one side last", grid_laplacian(3), both_sides()});
    SparseMatrix cut = grid_laplacian();  // rows that nothing touches
    for (Index c = 0; c < static_cast<Index>(cut.cols()); ++c)
        for (SparseMatrix::InnerIterator it(cut, c); it; ++it)
            if (it.row() % 5 == 0 || c % 5 == 0) it.valueRef() = it.row() == c ? 1.0 : 0.0;
    cut.prune([](Index, Index, double value) { return value != 0.0; });
    result.push_back({"single rows", cut, {1, 2, 3}});
    result.push_back({"lower triangle", grid_laplacian().triangularView<Eigen::Lower>(), both_sides()});
    return result;
}

}  // namespace

TEST(Dissection, pieces_have_no_entry_between_them_and_every_row_is_somewhere_once)
{
    for (const Case& c : cases()) {
        const Dissection dissection = dissect(c.matrix, c.last, piece_rows);
        const Index count = static_cast<Index>(dissection.nodes.size());
        ASSERT_GT(count, 7) << c.name;
        std::vector<Index> node(c.matrix.rows(), -1);
        for (Index i = 0; i < count; ++i) {
            EXPECT_TRUE(i + 1 == count ? dissection.nodes[i].parent == -1 : dissection.nodes[i].parent > i) << c.name;
            if (dissection.nodes[i].is_piece) {
                EXPECT_LE(static_cast<Index>(dissection.nodes[i].rows.size()), piece_rows) << c.name;
            }
            for (const Index v : dissection.nodes[i].rows) {
                EXPECT_EQ(node[v], -1);
                node[v] = i;
            }
        }
        for (const Index v : c.last) {
            EXPECT_EQ(node[v], -1);
            node[v] = count;
        }
        EXPECT_EQ(std::ranges::count(node, -1), 0) << c.name;
        const auto is_above = [&](Index upper, Index lower) {
            while (lower >= 0 && lower < upper) lower = lower == count - 1 ? count : dissection.nodes[lower].parent;
            return lower == upper;
        };
        for (Index v = 0; v < static_cast<Index>(c.matrix.cols()); ++v)
            for (SparseMatrix::InnerIterator it(c.matrix, v); it; ++it)
                EXPECT_TRUE(is_above(std::max(node[v], node[it.row()]), std::min(node[v], node[it.row()]))) << c.name;
    }
}

TEST(FactorInPieces, gives_what_the_whole_factor_gives)
{
    fix_product_blocks();
    for (const Case& c : cases()) {
        const Index size = static_cast<Index>(c.matrix.rows());
        const std::vector<MatrixXd> whole = answers(SparseCholesky(c.matrix, c.last, never), size, c.last);
        for (const Index most : {400, 60}) {
            const std::vector<MatrixXd> split = answers(SparseCholesky(c.matrix, c.last, most), size, c.last);
            ASSERT_EQ(split.size(), whole.size());
            for (std::size_t i = 0; i < whole.size(); ++i)
                EXPECT_LT(difference(split[i], whole[i]), 1e-11) << c.name << ", answer " << i;
        }
    }
}

TEST(FactorInPieces, is_the_same_on_any_number_of_threads)
{
    fix_product_blocks();
    for (const Case& c : cases()) {
        const Index size = static_cast<Index>(c.matrix.rows());
        const auto on = [&](int threads) {
            const ThreadShare share(threads);
            return answers(SparseCholesky(c.matrix, c.last, 60), size, c.last);
        };
        const std::vector<MatrixXd> one = on(1);
        for (const int threads : {2, 3, 5}) {
            const std::vector<MatrixXd> several = on(threads);
            for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], several[i]) << c.name << ", answer " << i;
        }
    }
}

TEST(FactorInPieces, takes_other_numbers_in_the_same_pattern)
{
    fix_product_blocks();
    for (const Case& c : cases()) {
        const ThreadShare share(2);
        SparseCholesky factor(c.matrix, c.last, piece_rows);
        const SparseMatrix other = 3.0 * c.matrix;
        factor.refactorize(other);
        const VectorXd f = some_numbers(other.rows());
        const SparseMatrix both = SparseMatrix(other.triangularView<Eigen::Lower>()).selfadjointView<Eigen::Lower>();
        EXPECT_LT(VectorXd(both * factor.solve(f) - f).cwiseAbs().maxCoeff(), 1e-10) << c.name;
    }
}

TEST(FactorInPieces, a_matrix_that_does_not_come_apart_is_factored_whole)
{
    fix_product_blocks();
    SparseMatrix dense = (MatrixXd::Constant(200, 200, -1e-3) + MatrixXd::Identity(200, 200)).sparseView();
    EXPECT_FALSE(analyze_in_pieces(dense, {}, 50).has_value());
    const VectorXd f = some_numbers(200);
    EXPECT_LT(VectorXd(dense * SparseCholesky(dense, {}, 50).solve(f) - f).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FactorInPieces, a_matrix_that_is_not_positive_definite_is_an_error)
{
    fix_product_blocks();
    for (const Index bad : {0, columns * rows / 2, columns * rows - 1}) {
        SparseMatrix matrix = grid_laplacian();
        matrix.coeffRef(bad, bad) = -1.0;
        for (const int threads : {1, 2}) {
            const ThreadShare share(threads);
            ASSERT_TRUE(analyze_in_pieces(matrix, {}, piece_rows).has_value());
            EXPECT_THROW(SparseCholesky(matrix, {}, piece_rows), SolverError);
        }
    }
}

TEST(ThreadShare, work_beside_other_work_takes_one_thread)
{
    EXPECT_EQ(ThreadShare::here(), 1);
    const ThreadShare share(3);
    EXPECT_EQ(ThreadShare::here(), 3);
    std::vector<int> seen(8, 0);
    each_beside(seen.size(), [&](std::size_t i) {
        const ThreadShare wanted(7);
        seen[i] = ThreadShare::here();
    });
    EXPECT_EQ(seen, std::vector<int>(8, 1));
    each_beside(1, [&](std::size_t) { EXPECT_EQ(ThreadShare::here(), 3); });
    EXPECT_EQ(ThreadShare::here(), 3);
}

TEST(ThreadShare, pieces_are_the_same_for_any_number_of_threads)
{
    for (const int threads : {1, 4}) {
        const ThreadShare share(threads);
        std::vector<int> times(1003, 0);
        in_pieces(times.size(), 100, [&](std::size_t begin, std::size_t end) {
            EXPECT_EQ(begin % 100, 0U);
            EXPECT_TRUE(end == begin + 100 || end == times.size());
            for (std::size_t i = begin; i < end; ++i) ++times[i];
        });
        EXPECT_EQ(times, std::vector<int>(1003, 1));
        in_pieces(0, 100, [](std::size_t, std::size_t) { FAIL(); });
    }
}
