#include "linear/sparse_cholesky.h"

#include "core/memory_limit.h"
#include "core/thread_share.h"
#include "linear/dense_spd.h"
#include "linear/elimination_order.h"
#include "linear/factor_numbers.h"
#include "linear/multifrontal_factor.h"
#include "linear/part_substitution.h"
#include "linear/selected_inverse.h"
#include "linear/supernodal_factor.h"

#include <algorithm>
#include <cmath>

namespace koebe {

using namespace detail;

namespace {

constexpr std::size_t solved_at_a_time = 32768;  // rows of a thread
constexpr Index pieces_of_large = 10;            // at least: more of them take longer to find than they save

}  // namespace

struct SparseCholesky::Impl {
    SupernodalFactor l;
    std::vector<Index> last;
    MatrixXd trailing;                           // L_BB in the factor's own order
    SparseMatrix both;                           // triangles of the matrix, where one was given
    std::unique_ptr<MultifrontalFactor> fronts;  // of a matrix that changes in a few rows
    std::unique_ptr<FactorNumbers> numbers;      // of one that changes as a whole

    const SparseMatrix& full(const SparseMatrix& matrix)
    {
        for (Index c = 0; c < static_cast<Index>(matrix.cols()); ++c)
            if (const SparseMatrix::InnerIterator it(matrix, c); it && it.row() < c) return matrix;
        both = matrix.selfadjointView<Eigen::Lower>();
        return both;
    }

    void analyze(const SparseMatrix& matrix);
    void take_trailing() { trailing = l.trailing_block(static_cast<Index>(last.size())); }
    Index inner_count() const { return l.size() - static_cast<Index>(last.size()); }
    Index place_in_trailing(std::size_t b) const { return l.rank[last[b]] - inner_count(); }
    MatrixXd half_solve(const MatrixXd& f);
    MatrixXd in_given_order(const MatrixXd& solution) const;
    MatrixXd last_in_given_order(const MatrixXd& trailing_rows) const;
    MatrixXd in_factors_order(const MatrixXd& last_values) const;
    MatrixXd back_substitution_to(const std::vector<Index>& wanted, MatrixXd y) const;
};

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last, Index split_rows)
    : impl_(std::make_unique<Impl>())
{
    impl_->last = last;
    if (SupernodalFactor& l = impl_->l; matrix.rows() > split_rows) {
        l.split = SplitFactor::analyze(impl_->full(matrix), last,
                                       std::max(split_rows, static_cast<Index>(matrix.rows() / pieces_of_large)));
        if (l.split) {
            require_memory(l.split->memory(), "the factorization");
            l.number();
            refactorize(matrix);
            return;
        }
    }
    impl_->analyze(matrix);
    refactorize(matrix);
}

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last,
                               const std::vector<std::vector<Index>>& changing)
    : impl_(std::make_unique<Impl>())
{
    impl_->last = last;
    impl_->analyze(matrix);
    impl_->fronts = std::make_unique<MultifrontalFactor>(impl_->l, matrix, changing);
}

void SparseCholesky::Impl::analyze(const SparseMatrix& matrix)
{
    cholmod_sparse lower = view(matrix, -1);
    // CHOLMOD's own postorder keeps B last whenever the graph of A_II is connected; where it does not, order and
    // postorder A_II by itself and forbid any further change.
    for (const bool forced : {false, true}) {
        std::vector<Index> order;
        if (!last.empty()) order = elimination_order(matrix, last, forced, l.common);
        l.common->nmethods = 1;
        l.common->method[0].ordering = last.empty() ? CHOLMOD_AMD : CHOLMOD_GIVEN;
        l.common->postorder = forced ? 0 : 1;
        l.factor =
            own(cholmod_analyze_p(&lower, last.empty() ? nullptr : order.data(), nullptr, 0, l.common.get()), l.common);
        l.common.require(l.factor != nullptr, "symbolic analysis");
        require_memory(8.0 * (static_cast<double>(l.factor->xsize) + 2.0 * std::pow(last.size(), 2)),
                       "the factorization");
        l.number();
        if (std::all_of(last.begin(), last.end(), [&](Index v) { return l.rank[v] >= inner_count(); })) break;
    }
}

void SparseCholesky::refactorize(const SparseMatrix& matrix)
{
    SupernodalFactor& l = impl_->l;
    if (impl_->fronts) return impl_->fronts->take(matrix);
    if (l.split) {
        l.split->factorize(impl_->full(matrix));
        impl_->both = {};
        return impl_->take_trailing();
    }
    if (!impl_->numbers) impl_->numbers = std::make_unique<FactorNumbers>(l);
    impl_->numbers->take(matrix);
    impl_->take_trailing();
}

void SparseCholesky::refactorize(const std::vector<MatrixXd>& blocks)
{
    impl_->fronts->refactorize(blocks);
    impl_->take_trailing();
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

MatrixXd SparseCholesky::solve(const MatrixXd& right_hand_side) const
{
    return impl_->l.solve(CHOLMOD_A, right_hand_side);
}

MatrixXd SparseCholesky::last_schur() const
{
    const MatrixXd product = lower_times_transpose(impl_->trailing);
    std::vector<Index> place(impl_->last.size());
    for (std::size_t b = 0; b < place.size(); ++b) place[b] = impl_->place_in_trailing(b);
    return product(place, place);
}

/// L y = (f_I, 0) has y_I = L_II^-1 f_I and L_BB y_B = -L_BI y_I; in the factor's own order.
MatrixXd SparseCholesky::Impl::half_solve(const MatrixXd& f)
{
    MatrixXd load = MatrixXd::Zero(l.size(), f.cols());
    in_pieces(static_cast<std::size_t>(inner_count()), solved_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Index c = 0; c < static_cast<Index>(f.cols()); ++c)
            for (std::size_t j = begin; j < end; ++j) load(j, c) = f(l.order()[j], c);
    });
    return l.solve(CHOLMOD_L, load);
}

MatrixXd SparseCholesky::Impl::in_given_order(const MatrixXd& solution) const
{
    MatrixXd result(solution.rows(), solution.cols());
    in_pieces(static_cast<std::size_t>(result.rows()), solved_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Index c = 0; c < static_cast<Index>(result.cols()); ++c)
            for (std::size_t j = begin; j < end; ++j) result(l.order()[j], c) = solution(j, c);
    });
    return result;
}

MatrixXd SparseCholesky::Impl::last_in_given_order(const MatrixXd& trailing_rows) const
{
    MatrixXd result(trailing_rows.rows(), trailing_rows.cols());
    for (std::size_t b = 0; b < last.size(); ++b) result.row(b) = trailing_rows.row(place_in_trailing(b));
    return result;
}

MatrixXd SparseCholesky::Impl::in_factors_order(const MatrixXd& last_values) const
{
    MatrixXd values(last_values.rows(), last_values.cols());
    for (std::size_t b = 0; b < last.size(); ++b) values.row(place_in_trailing(b)) = last_values.row(b);
    return values;
}

/// @param y (C, n), in the factor's order
MatrixXd SparseCholesky::Impl::back_substitution_to(const std::vector<Index>& wanted, MatrixXd y) const
{
    PartSubstitution(l).backward(y, wanted);
    MatrixXd result(wanted.size(), y.rows());
    for (std::size_t i = 0; i < wanted.size(); ++i) result.row(i) = y.col(l.rank[wanted[i]]).transpose();
    return result;
}

MatrixXd SparseCholesky::solve_for(const std::vector<Index>& wanted, const MatrixXd& f) const
{
    return impl_->back_substitution_to(wanted, PartSubstitution(impl_->l).forward(f));
}

MatrixXd SparseCholesky::extend_to(const std::vector<Index>& wanted, const MatrixXd& last_values) const
{
    MatrixXd y = MatrixXd::Zero(last_values.cols(), impl_->l.size());
    y.rightCols(last_values.rows()) =
        (impl_->trailing.triangularView<Eigen::Lower>().transpose() * impl_->in_factors_order(last_values)).transpose();
    return impl_->back_substitution_to(wanted, std::move(y));
}

/// L' x = (y_I, L_BB' x_B) has x_I = L_II^-T (y_I - L_BI' x_B).
MatrixXd SparseCholesky::extend(const MatrixXd& last_values, const MatrixXd& f) const
{
    const Index count = static_cast<Index>(impl_->last.size());
    const MatrixXd values = impl_->in_factors_order(last_values);
    MatrixXd load = f.size() > 0 ? impl_->half_solve(f) : MatrixXd(MatrixXd::Zero(impl_->l.size(), last_values.cols()));
    load.bottomRows(count) = impl_->trailing.triangularView<Eigen::Lower>().transpose() * values;
    const MatrixXd solution = impl_->l.solve(CHOLMOD_Lt, load);

    MatrixXd result = impl_->in_given_order(solution);
    result(impl_->last, Eigen::all) = last_values;
    return result;
}

MatrixXd SparseCholesky::flux_to_last(const MatrixXd& f) const
{
    const MatrixXd half = impl_->half_solve(f);
    return impl_->last_in_given_order(impl_->trailing.triangularView<Eigen::Lower>() *
                                      half.bottomRows(static_cast<Index>(impl_->last.size())));
}

std::pair<VectorXd, VectorXd> SparseCholesky::solve_inner(const VectorXd& f) const
{
    const Index count = static_cast<Index>(impl_->last.size());
    MatrixXd half = impl_->half_solve(f);
    const MatrixXd flux = impl_->trailing.triangularView<Eigen::Lower>() * half.bottomRows(count);
    half.bottomRows(count).setZero();
    const MatrixXd solution = impl_->l.solve(CHOLMOD_Lt, half);
    return {impl_->in_given_order(solution), impl_->last_in_given_order(flux)};
}

std::vector<MatrixXd> SparseCholesky::inverse_blocks(const std::vector<std::vector<Index>>& sets) const
{
    return selected_inverse(impl_->l, sets);
}

DirichletSolver::DirichletSolver(const SparseMatrix& laplacian, const std::vector<char>& fixed)
{
    std::vector<Index> rank(fixed.size());
    for (std::size_t v = 0; v < fixed.size(); ++v) {
        std::vector<Index>& part = fixed[v] ? fixed_ : free_;
        rank[v] = static_cast<Index>(part.size());
        part.push_back(static_cast<Index>(v));
    }
    if (free_.empty()) return;
    SparseMatrix inner(free_.size(), free_.size());
    inner.reserve(laplacian.nonZeros());
    std::vector<Eigen::Triplet<double, Index>> coupling;
    for (std::size_t c = 0; c < free_.size(); ++c) {
        inner.startVec(c);
        for (SparseMatrix::InnerIterator it(laplacian, free_[c]); it; ++it) {
            if (fixed[it.row()])
                coupling.emplace_back(static_cast<Index>(c), rank[it.row()], it.value());
            else
                inner.insertBack(rank[it.row()], c) = it.value();
        }
    }
    inner.finalize();
    coupling_.resize(free_.size(), fixed_.size());
    coupling_.setFromTriplets(coupling.begin(), coupling.end());
    cholesky_ = std::make_unique<SparseCholesky>(inner);
}

MatrixXd DirichletSolver::solve(const MatrixXd& values) const
{
    MatrixXd result = values;
    if (free_.empty()) return result;
    const MatrixXd inner = cholesky_->solve(-(coupling_ * values(fixed_, Eigen::all)));
    result(free_, Eigen::all) = inner;
    return result;
}

}  // namespace koebe
