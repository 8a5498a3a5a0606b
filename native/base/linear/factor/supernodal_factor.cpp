#include "linear/factor/supernodal_factor.h"

#include "core/errors.h"
#include "core/types.h"
#include "execution/each_in_pieces.h"
#include "execution/profile.h"
#include "execution/thread_share.h"
#include "linear/dense_blas.h"
#include "linear/factor/piece_factor.h"

#include <algorithm>
#include <utility>

namespace koebe::detail {
namespace {

constexpr Index front_block = 128;  // columns
constexpr Index front_rows = 512;   // rows of a triangular solve

/// Factors the first columns of a symmetric matrix and computes the Schur complement on the others. Works by blocks on
/// the thread's share of threads; any number of threads gives the same result.
/// @param columns (height, width) in: the first columns, lower triangle; out: L, entries above its diagonal undefined
/// @param rest (height - width, height - width) in: the other columns, lower triangle; out: the Schur complement
/// @throws SolverError if the matrix is not positive definite
void eliminate(double* columns, Index height, Index width, double* rest)
{
    const double one = 1.0;
    const auto at = [&](Index row, Index column) {
        return columns + row + static_cast<std::ptrdiff_t>(column) * height;
    };
    // Right-looking, by blocks: L_pp L_pp' = A_pp, L_rp = A_rp L_pp^-T, and A_rr -= L_rp L_rp' among the columns.
    for (Index p = 0; p < width; p += front_block) {
        const int block = std::min(front_block, width - p);
        int info = 0;
        dpotrf_("L", &block, at(p, p), &height, &info);
        if (info != 0) throw SolverError("sparse factorization: the matrix is not positive definite");
        const Index begin = p + block;
        in_pieces(height - begin, front_rows, [&](std::size_t from, std::size_t until) {
            const int rows = static_cast<int>(until - from);
            dtrsm_("R", "L", "T", "N", &rows, &block, &one, at(p, p), &height, at(begin + static_cast<Index>(from), p),
                   &height);
        });
        in_pieces(width - begin, front_block, [&](std::size_t from, std::size_t until) {
            const Index c = begin + static_cast<Index>(from);
            lower_product(height - c, static_cast<int>(until - from), block, -1.0, at(c, p), height, 1.0, at(c, c),
                          height);
        });
    }
    // The other columns see all blocks at once.
    const Index others = height - width;
    in_pieces(others, front_block, [&](std::size_t from, std::size_t until) {
        const Index c = static_cast<Index>(from);
        lower_product(others - c, static_cast<int>(until - from), width, -1.0, at(width + c, 0), height, 1.0,
                      rest + c + static_cast<std::ptrdiff_t>(c) * others, others);
    });
}

/// Does the block's part of X = L^-1 X. @param block (height, width) of L @param first the block's first row in X
/// @param update (height - width, n) out: to be added to the rows below
void substitute_forward(const double* block, Index height, Index width, Index first, MatrixXd& x, MatrixXd& update)
{
    const int count = static_cast<int>(x.cols()), stride = static_cast<int>(x.rows()), below = height - width;
    const double one = 1.0, minus_one = -1.0, zero = 0.0;
    double* own = &x(first, 0);
    update = MatrixXd(below, count);  // resize() would free it twice when memory runs out
    dtrsm_("L", "L", "N", "N", &width, &count, &one, block, &height, own, &stride);
    if (below > 0)
        dgemm_("N", "N", &below, &count, &width, &minus_one, block + width, &height, own, &stride, &zero, update.data(),
               &below);
}

/// Does the block's part of X = L^-T X. @param rows (height - width) row numbers below the block
void substitute_backward(const double* block, Index height, Index width, Index first, const Index* rows, MatrixXd& x)
{
    const int count = static_cast<int>(x.cols()), stride = static_cast<int>(x.rows()), below = height - width;
    const double one = 1.0, minus_one = -1.0;
    double* own = &x(first, 0);
    if (below > 0) {
        MatrixXd above(below, count);
        for (Index r = 0; r < below; ++r) above.row(r) = x.row(rows[r]);
        dgemm_("T", "N", &width, &count, &below, &minus_one, block + width, &height, above.data(), &below, &one, own,
               &stride);
    }
    dtrsm_("L", "L", "T", "N", &width, &count, &one, block, &height, own, &stride);
}

}  // namespace

SupernodalFactor::SupernodalFactor(Analysis analysis)
    : Supernodes(std::move(analysis.supernodes)),
      parts_(std::move(analysis.parts)),
      piece_count_(analysis.piece_count),
      rounds_(std::move(analysis.rounds)),
      tops_(analysis.tops),
      numbers_(static_cast<std::size_t>(value_begin.back()))
{
}

void SupernodalFactor::factorize(const SparseMatrix& matrix, const DiagonalShift& shift)
{
    const ProfiledStage profiled("eliminate");
    const MatrixPlaces* const places = is_in_pieces() ? nullptr : pattern_.places(matrix, *this);
    RestPool pool;
    std::vector<LowerMatrix> rests(parts_.size());
    each_beside(piece_count_, [&](std::size_t p) {
        rests[p] = pool.take(static_cast<Index>(parts_[p].interface.size()));
        factorize_piece(matrix, shift, *this, parts_[p], tops_, numbers_.data(), rests[p], places);
    });
    constexpr std::size_t few = 2;  // so few are done one after the other, each on all threads
    for (const std::vector<std::size_t>& round : rounds_)
        if (round.size() > few)
            each_beside(round.size(),
                        [&](std::size_t i) { factorize_separator(matrix, shift, parts_[round[i]], rests, pool); });
        else
            for (const std::size_t p : round) factorize_separator(matrix, shift, parts_[p], rests, pool);
}

void SupernodalFactor::factorize_separator(const SparseMatrix& matrix, const DiagonalShift& shift,
                                           const FactorPart& part, std::vector<LowerMatrix>& rests, RestPool& pool)
{
    const Index columns = part.end - part.begin, others = static_cast<Index>(part.interface.size());
    const Index rows = columns + others;
    std::vector<Index> place(order.size() - tops_);
    for (Index r = 0; r < columns; ++r) place[part.begin + r - tops_] = r;
    for (Index r = 0; r < others; ++r) place[part.interface[r] - tops_] = columns + r;
    double* block = columns > 0 ? values(part.first_supernode) : nullptr;
    LowerMatrix rest = pool.take(others);
    // The columns of the matrix.
    std::fill(block, block + static_cast<std::ptrdiff_t>(columns) * rows, 0.0);
    for (Index c = 0; c < columns; ++c)
        for (SparseMatrix::InnerIterator it(matrix, order[part.begin + c]); it; ++it)
            if (const Index r = rank[it.row()]; r >= part.begin + c)
                block[place[r - tops_] + static_cast<std::ptrdiff_t>(c) * rows] = it.value();
    for (Index c = std::max(shift.first - part.begin, 0); c < columns; ++c)
        block[c + static_cast<std::ptrdiff_t>(c) * rows] += shift.number;
    // Extend-add: what each child leaves on its interface.
    for (const std::size_t child : part.children) {
        LowerMatrix from = std::exchange(rests[child], {});
        const std::vector<Index>& from_rows = parts_[child].interface;
        in_pieces(from_rows.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const Index column = place[from_rows[c] - tops_];
                double* to = column < columns ? block + static_cast<std::ptrdiff_t>(column) * rows
                                              : rest.column(column - columns) - columns;
                const double* numbers = from.column(static_cast<Index>(c));
                for (std::size_t r = c; r < from_rows.size(); ++r) to[place[from_rows[r] - tops_]] += numbers[r];
            }
        });
        pool.give_back(std::move(from));
    }
    eliminate(block, rows, columns, rest.numbers.data());
    rests[&part - parts_.data()] = std::move(rest);
}

MatrixXd SupernodalFactor::trailing_block(Index last) const
{
    MatrixXd trailing = MatrixXd::Zero(last, last);
    const Index begin = size() - last;
    for (Index s = last > 0 ? supernode[begin] : count(); s < count(); ++s)
        for (Index column = std::max(first[s], begin); column < first[s + 1]; ++column) {
            const Index at = column - first[s];
            const double* values_of_column = values(s) + static_cast<std::ptrdiff_t>(at) * height(s);
            for (Index r = at; r < height(s); ++r)
                trailing(rows_of(s)[r] - begin, column - begin) = values_of_column[r];
        }
    return trailing;
}

MatrixXd SupernodalFactor::solve(const MatrixXd& right_hand_side) const
{
    MatrixXd result(right_hand_side.rows(), right_hand_side.cols());
    if (result.size() == 0) return result;
    MatrixXd x(right_hand_side.rows(), right_hand_side.cols());
    for (Eigen::Index c = 0; c < x.cols(); ++c)
        each_in_pieces(size(), [&](Index j) { x(j, c) = right_hand_side(order[j], c); });
    solve_lower(x);
    solve_upper(x);
    for (Eigen::Index c = 0; c < x.cols(); ++c) each_in_pieces(size(), [&](Index j) { result(order[j], c) = x(j, c); });
    return result;
}

void SupernodalFactor::solve_lower(MatrixXd& x) const
{
    const ProfiledStage profiled("substitute");
    const Index columns = static_cast<Index>(x.cols()), top_count = size() - tops_;
    std::vector<MatrixXd> arrived(piece_count_);
    each_beside(piece_count_, [&](std::size_t p) {
        arrived[p] = MatrixXd::Zero(top_count, columns);
        solve_lower(parts_[p], x, arrived[p]);
    });
    for (std::size_t p = 0; p < piece_count_; ++p)
        for (const Index r : parts_[p].interface) x.row(r) += arrived[p].row(r - tops_);
    MatrixXd top = MatrixXd::Zero(top_count, columns);
    for (std::size_t p = piece_count_; p < parts_.size(); ++p) {
        x.middleRows(parts_[p].begin, parts_[p].end - parts_[p].begin) +=
            top.middleRows(parts_[p].begin - tops_, parts_[p].end - parts_[p].begin);
        solve_lower(parts_[p], x, top);
    }
}

void SupernodalFactor::solve_lower(const FactorPart& part, MatrixXd& x, MatrixXd& interface) const
{
    MatrixXd update;
    for (Index s = part.first_supernode; s < part.last_supernode; ++s) {
        substitute_forward(values(s), height(s), width(s), first[s], x, update);
        const Index* rows = rows_of(s) + width(s);
        for (Index r = 0; r < static_cast<Index>(update.rows()); ++r)
            if (rows[r] < part.end)
                x.row(rows[r]) += update.row(r);
            else
                interface.row(rows[r] - tops_) += update.row(r);
    }
}

void SupernodalFactor::solve_upper(MatrixXd& x) const
{
    const ProfiledStage profiled("substitute");
    for (std::size_t p = parts_.size(); p-- > piece_count_;) solve_upper(parts_[p], x);
    each_beside(piece_count_, [&](std::size_t p) { solve_upper(parts_[p], x); });
}

void SupernodalFactor::solve_upper(const FactorPart& part, MatrixXd& x) const
{
    for (Index s = part.last_supernode; s-- > part.first_supernode;)
        substitute_backward(values(s), height(s), width(s), first[s], rows_of(s) + width(s), x);
}

}  // namespace koebe::detail
