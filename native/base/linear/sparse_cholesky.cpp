#include "linear/sparse_cholesky.h"

#include "core/numbering.h"
#include "execution/memory_limit.h"
#include "execution/profile.h"
#include "execution/thread_share.h"
#include "linear/dense_blas.h"
#include "linear/dense_spd.h"
#include "linear/factor/analysis.h"
#include "linear/factor/multifrontal_factor.h"
#include "linear/factor/part_substitution.h"
#include "linear/factor/subtrees.h"
#include "linear/factor/supernodal_factor.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace koebe {

using namespace detail;

namespace {

/// The inverse on the pattern of some supernodes. Each has a block like its block in L: first the rows of its columns
/// J, lower triangle, then R.
class PatternInverse {
public:
    explicit PatternInverse(const SupernodalFactor& l) : l_(l), blocks_(l.count()) {}

    void compute(Index s)
    {
        const int width = l_.width(s), height = l_.height(s), below = height - width;
        const Index* rows = l_.rows_of(s) + width;
        MatrixXd& z = blocks_[s];
        z = Eigen::Map<const MatrixXd>(l_.values(s), height, width);
        const MatrixXd y = below_times_inverse(s);
        int info = 0;
        dpotri_("L", &width, z.data(), &height, &info);  // L_JJ^-T L_JJ^-1
        if (below == 0) return;

        const MatrixXd corner = lower_at(rows, below);  // Z_RR
        const double one = 1.0, minus_one = -1.0, zero = 0.0;
        double* lower_part = z.data() + width;
        dsymm_("L", "L", &below, &width, &minus_one, corner.data(), &below, y.data(), &below, &zero, lower_part,
               &height);
        dgemm_("T", "N", &width, &width, &below, &minus_one, y.data(), &below, lower_part, &height, &one, z.data(),
               &height);
    }

    /// The block of some of L's rows, which ascend: its lower triangle.
    MatrixXd lower_at(const Index* rows, int count) const
    {
        MatrixXd result(count, count);
        std::vector<Index> place(count);
        for (int c = 0; c < count;) {
            // Rows that are columns of one supernode stand side by side.
            const Index owner = l_.supernode[rows[c]];
            int end = c;
            while (end < count && l_.supernode[rows[end]] == owner) ++end;
            locate(owner, rows, c, place);
            for (int column = c; column < end; ++column) {
                const double* from = &blocks_[owner](0, rows[column] - l_.first[owner]);
                for (int r = column; r < count; ++r) result(r, column) = from[place[r]];
            }
            c = end;
        }
        return result;
    }

private:
    /// L_RJ L_JJ^-1.
    MatrixXd below_times_inverse(Index s) const
    {
        const int width = l_.width(s), height = l_.height(s), below = height - width;
        MatrixXd y = Eigen::Map<const MatrixXd>(l_.values(s), height, width).bottomRows(below);
        const double one = 1.0;
        if (below > 0) dtrsm_("R", "L", "N", "N", &below, &width, &one, l_.values(s), &height, y.data(), &below);
        return y;
    }

    /// The places of the rows from number `first` on among a supernode's rows; both ascend.
    void locate(Index owner, const Index* rows, int first, std::vector<Index>& place) const
    {
        const Index* among = l_.rows_of(owner);
        Index at = 0;
        for (std::size_t r = first; r < place.size(); ++r) {
            while (among[at] != rows[r]) ++at;
            place[r] = at;
        }
    }

    const SupernodalFactor& l_;
    std::vector<MatrixXd> blocks_;
};

/// Blocks of A^-1, A = L L', for sets of rows; A has an entry between any two rows of a set. Goes from the root of the
/// elimination tree down: for a supernode of the columns J with the rows R below, Z_RJ = -Z_RR L_RJ L_JJ^-1 and Z_JJ =
/// L_JJ^-T L_JJ^-1 - (L_RJ L_JJ^-1)' Z_RJ (Takahashi, Fagan and Chin 1973; Erisman and Tinney 1975). Visits only the
/// supernodes from the sets up to the root.
/// @return for each set its block, rows and columns in the given order
std::vector<MatrixXd> selected_inverse(const SupernodalFactor& l, const std::vector<std::vector<Index>>& sets)
{
    const ProfiledStage profiled("invert");
    // The supernodes of the sets, and all above them.
    std::vector<char> needed(l.count(), 0);
    for (const std::vector<Index>& set : sets)
        for (const Index v : set)
            for (Index s = l.supernode[l.rank[v]]; !needed[s]; s = l.parent(s)) needed[s] = 1;
    PatternInverse inverse(l);
    Subtrees(l, needed).downward([&](const std::vector<Index>& supernodes) {
        std::for_each(supernodes.rbegin(), supernodes.rend(), [&](Index s) { inverse.compute(s); });
    });

    // Read the blocks, of which the pattern has the lower half in the order of elimination.
    std::vector<MatrixXd> result(sets.size());
    each_beside(sets.size(), [&](std::size_t k) {
        const std::vector<Index>& set = sets[k];
        std::vector<Index> order = numbers_below(static_cast<Index>(set.size())), rows;
        std::ranges::sort(order, {}, [&](Index i) { return l.rank[set[i]]; });
        for (const Index i : order) rows.push_back(l.rank[set[i]]);
        const MatrixXd lower = inverse.lower_at(rows.data(), static_cast<int>(rows.size()));
        MatrixXd& block = result[k];
        block.resize(lower.rows(), lower.cols());
        for (Eigen::Index c = 0; c < lower.cols(); ++c)
            for (Eigen::Index r = c; r < lower.rows(); ++r)
                block(order[r], order[c]) = block(order[c], order[r]) = lower(r, c);
    });
    return result;
}

constexpr std::size_t solved_at_a_time = 32768;  // rows per thread
constexpr Index pieces_of_large = 10;            // at least; more pieces take longer to find than they save

/// @param room memory for the matrix with its upper triangle, if that is missing
const SparseMatrix& both_triangles(const SparseMatrix& matrix, SparseMatrix& room)
{
    for (Index c = 0; c < static_cast<Index>(matrix.cols()); ++c)
        if (const SparseMatrix::InnerIterator it(matrix, c); it && it.row() < c) return matrix;
    room = matrix.selfadjointView<Eigen::Lower>();
    return room;
}

}  // namespace

struct SparseCholesky::Impl {
    Impl(Analysis analysis, const std::vector<Index>& rows_kept_last, double added_to_last)
        : l(std::move(analysis)), last(rows_kept_last), shift{inner_count(), added_to_last}
    {
    }

    SupernodalFactor l;
    std::vector<Index> last;
    DiagonalShift shift;
    MatrixXd trailing;                           // L_BB in the factor's own order
    std::unique_ptr<MultifrontalFactor> fronts;  // for a matrix that changes in a few rows

    /// @throws OutOfMemory where the factor would not fit
    static std::unique_ptr<Impl> of(Analysis analysis, const std::vector<Index>& last, double shift = 0.0)
    {
        const double trailing_and_schur = 2.0 * sizeof(double) * std::pow(last.size(), 2);
        require_memory(analysis.memory() + trailing_and_schur, "the factorization");
        return std::make_unique<Impl>(std::move(analysis), last, shift);
    }

    void take(const SparseMatrix& matrix)
    {
        l.factorize(matrix, shift);
        take_trailing();
    }
    void take_trailing() { trailing = l.trailing_block(static_cast<Index>(last.size())); }
    Index inner_count() const { return l.size() - static_cast<Index>(last.size()); }
    Index place_in_trailing(std::size_t b) const { return l.rank[last[b]] - inner_count(); }
    MatrixXd half_solve(const MatrixXd& f) const;
    MatrixXd in_given_order(const MatrixXd& solution) const;
    MatrixXd last_in_given_order(const MatrixXd& trailing_rows) const;
    MatrixXd in_factors_order(const MatrixXd& last_values) const;
    MatrixXd back_substitution_to(const std::vector<Index>& wanted, MatrixXd y) const;
};

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last, Index split_rows,
                               double shift)
{
    const Index size = static_cast<Index>(matrix.rows());
    const bool large = size > split_rows;
    SparseMatrix room;
    const SparseMatrix& given = large ? both_triangles(matrix, room) : matrix;
    std::optional<Analysis> pieces;
    if (large) pieces = analyze_in_pieces(given, last, std::max(split_rows, size / pieces_of_large));
    impl_ = Impl::of(pieces ? *std::move(pieces) : analyze(given, last), last, shift);
    impl_->take(given);
}

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last,
                               const std::vector<std::vector<Index>>& changing, bool by_fill)
    : impl_(Impl::of(analyze(matrix, last, by_fill), last))
{
    impl_->fronts = std::make_unique<MultifrontalFactor>(impl_->l, matrix, changing);
}

void SparseCholesky::refactorize(const SparseMatrix& matrix)
{
    if (impl_->fronts) return impl_->fronts->take(matrix);
    SparseMatrix room;
    impl_->take(impl_->l.is_in_pieces() ? both_triangles(matrix, room) : matrix);
}

void SparseCholesky::refactorize(const std::vector<MatrixXd>& blocks)
{
    impl_->fronts->refactorize(blocks);
    impl_->take_trailing();
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Index SparseCholesky::size() const { return impl_->l.size(); }

MatrixXd SparseCholesky::solve(const MatrixXd& right_hand_side) const { return impl_->l.solve(right_hand_side); }

MatrixXd SparseCholesky::last_schur() const
{
    const MatrixXd product = lower_times_transpose(impl_->trailing);
    std::vector<Index> place(impl_->last.size());
    for (std::size_t b = 0; b < place.size(); ++b) place[b] = impl_->place_in_trailing(b);
    return product(place, place);
}

/// L y = (f_I, 0) has y_I = L_II^-1 f_I and L_BB y_B = -L_BI y_I; in the factor's own order.
MatrixXd SparseCholesky::Impl::half_solve(const MatrixXd& f) const
{
    MatrixXd load = MatrixXd::Zero(l.size(), f.cols());
    in_pieces(static_cast<std::size_t>(inner_count()), solved_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Index c = 0; c < static_cast<Index>(f.cols()); ++c)
            for (std::size_t j = begin; j < end; ++j) load(j, c) = f(l.order[j], c);
    });
    l.solve_lower(load);
    return load;
}

MatrixXd SparseCholesky::Impl::in_given_order(const MatrixXd& solution) const
{
    MatrixXd result(solution.rows(), solution.cols());
    in_pieces(static_cast<std::size_t>(result.rows()), solved_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Index c = 0; c < static_cast<Index>(result.cols()); ++c)
            for (std::size_t j = begin; j < end; ++j) result(l.order[j], c) = solution(j, c);
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
    impl_->l.solve_upper(load);

    MatrixXd result = impl_->in_given_order(load);
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
    impl_->l.solve_upper(half);
    return {impl_->in_given_order(half), impl_->last_in_given_order(flux)};
}

std::vector<MatrixXd> SparseCholesky::inverse_blocks(const std::vector<std::vector<Index>>& sets) const
{
    return selected_inverse(impl_->l, sets);
}

DirichletSolver::DirichletSolver(const SparseMatrix& laplacian, const std::vector<char>& fixed)
{
    // Split L in free and fixed unknowns: L_ff u_f = -L_fc u_c.
    std::vector<Index> rank(fixed.size());
    for (std::size_t v = 0; v < fixed.size(); ++v) {
        std::vector<Index>& part = fixed[v] ? fixed_ : free_;
        rank[v] = static_cast<Index>(part.size());
        part.push_back(static_cast<Index>(v));
    }
    if (free_.empty()) return;
    // L_ff column by column, already sorted; L_fc as triplets.
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
