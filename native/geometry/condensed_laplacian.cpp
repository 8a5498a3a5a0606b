#include "geometry/condensed_laplacian.h"

#include "geometry/cholmod_support.h"
#include "geometry/dense_spd.h"

#include <algorithm>
#include <optional>

namespace koebe {

using namespace detail;

namespace {

/// The interior in a fill-reducing order, then the boundary as given.
std::vector<Index> boundary_last_order(const SparseMatrix& laplacian, const std::vector<Index>& boundary,
                                       Ordering ordering, bool postordered, CholmodCommon& common)
{
    const Index vertex_count = static_cast<Index>(laplacian.rows());
    std::vector<Index> rank(vertex_count, 0);
    for (const Index v : boundary) rank[v] = -1;
    std::vector<Index> interior;
    for (Index v = 0; v < vertex_count; ++v)
        if (rank[v] == 0) {
            rank[v] = static_cast<Index>(interior.size());
            interior.push_back(v);
        }

    SparseMatrix inner(interior.size(), interior.size());
    inner.reserve(laplacian.nonZeros());
    for (std::size_t c = 0; c < interior.size(); ++c) {
        inner.startVec(c);
        for (SparseMatrix::InnerIterator it(laplacian, interior[c]); it; ++it)
            if (rank[it.row()] >= static_cast<Index>(c)) inner.insertBack(rank[it.row()], c) = it.value();
    }
    inner.finalize();

    std::vector<Index> order(interior.size());
    if (!interior.empty()) {
        cholmod_sparse lower = view(inner, -1);
        if (postordered) {
            common->nmethods = 1;
            common->method[0].ordering = ordering == Ordering::amd ? CHOLMOD_AMD : CHOLMOD_METIS;
            common->postorder = 1;
            const Factor symbolic = own(cholmod_analyze(&lower, common.get()), common);
            common.require(symbolic != nullptr, "ordering");
            const Index* perm = static_cast<const Index*>(symbolic->Perm);
            order.assign(perm, perm + interior.size());
        } else {
            const int done = ordering == Ordering::amd
                                 ? cholmod_amd(&lower, nullptr, 0, order.data(), common.get())
                                 : cholmod_metis(&lower, nullptr, 0, 0, order.data(), common.get());
            common.require(done != 0, "ordering");
        }
    }
    for (Index& v : order) v = interior[v];
    order.insert(order.end(), boundary.begin(), boundary.end());
    return order;
}

/// K on the interior, the unit matrix on the boundary, nothing between them.
SparseMatrix cut_off(const SparseMatrix& laplacian, const std::vector<Index>& boundary)
{
    std::vector<char> on_boundary(laplacian.rows(), 0);
    for (const Index v : boundary) on_boundary[v] = 1;
    SparseMatrix result = laplacian;
    for (Index column = 0; column < static_cast<Index>(result.cols()); ++column)
        for (SparseMatrix::InnerIterator it(result, column); it; ++it)
            if (on_boundary[it.row()] || on_boundary[column]) it.valueRef() = it.row() == column ? 1.0 : 0.0;
    result.prune([](Index, Index, double value) { return value != 0.0; });
    return result;
}

}  // namespace

struct CondensedLaplacian::Impl {
    // Without sigma: K, and the factor of K with the boundary cut off it, 1 in its place.
    SparseMatrix laplacian;
    std::optional<SparseCholesky> interior;

    CholmodCommon common;
    Factor factor;
    Index vertex_count = 0;
    Index interior_count = 0;
    std::vector<Index> position;        // of each boundary vertex among the trailing columns of L
    std::vector<Index> boundary;
    MatrixXd trailing;                  // L_BB as a dense lower triangle, in the factor's own order

    MatrixXd trailing_factor() const;
    MatrixXd solve(int system, const MatrixXd& right_hand_side);
};

CondensedLaplacian::CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary,
                                       Ordering ordering, std::size_t most_condensed)
    : impl_(std::make_unique<Impl>())
{
    impl_->vertex_count = static_cast<Index>(laplacian.rows());
    impl_->interior_count = impl_->vertex_count - static_cast<Index>(boundary.size());
    impl_->boundary = boundary;
    if (boundary.size() > most_condensed) {
        impl_->laplacian = laplacian;
        impl_->interior.emplace(cut_off(laplacian, boundary), ordering);
        return;
    }
    CholmodCommon& common = impl_->common;

    SparseMatrix shifted = laplacian;
    for (const Index v : boundary) shifted.coeffRef(v, v) += 1.0;
    cholmod_sparse lower = view(shifted, -1);

    // CHOLMOD's own postorder keeps the boundary last whenever the interior is connected; where it does not,
    // order and postorder the interior by itself and forbid any further change.
    std::vector<Index> rank(impl_->vertex_count, -1);
    for (const bool forced : {false, true}) {
        std::vector<Index> order = boundary_last_order(laplacian, boundary, ordering, forced, common);
        common->nmethods = 1;
        common->method[0].ordering = CHOLMOD_GIVEN;
        common->postorder = forced ? 0 : 1;
        impl_->factor = own(cholmod_analyze_p(&lower, order.data(), nullptr, 0, common.get()), common);
        common.require(impl_->factor != nullptr, "symbolic analysis");
        const Index* perm = static_cast<const Index*>(impl_->factor->Perm);
        for (Index j = 0; j < impl_->vertex_count; ++j) rank[perm[j]] = j;
        if (std::all_of(boundary.begin(), boundary.end(),
                        [&](Index v) { return rank[v] >= impl_->interior_count; }))
            break;
    }
    for (const Index v : boundary) impl_->position.push_back(rank[v] - impl_->interior_count);
    const int done = cholmod_factorize(&lower, impl_->factor.get(), common.get());
    common.require(done != 0, "numeric factorization (Laplacian not positive definite)");
    impl_->trailing = impl_->trailing_factor();
}

CondensedLaplacian::~CondensedLaplacian() = default;
CondensedLaplacian::CondensedLaplacian(CondensedLaplacian&&) noexcept = default;
CondensedLaplacian& CondensedLaplacian::operator=(CondensedLaplacian&&) noexcept = default;

/// L_BB, gathered from the supernodes.
MatrixXd CondensedLaplacian::Impl::trailing_factor() const
{
    const Index m = vertex_count - interior_count;
    MatrixXd trailing = MatrixXd::Zero(m, m);
    const Index* super = static_cast<const Index*>(factor->super);
    const Index* row_begin = static_cast<const Index*>(factor->pi);
    const Index* value_begin = static_cast<const Index*>(factor->px);
    const Index* rows = static_cast<const Index*>(factor->s);
    const double* values = static_cast<const double*>(factor->x);
    for (std::size_t s = 0; s < factor->nsuper; ++s) {
        if (super[s + 1] <= interior_count) continue;
        const Index height = row_begin[s + 1] - row_begin[s];
        for (Index column = std::max(super[s], interior_count); column < super[s + 1]; ++column)
            for (Index r = column - super[s]; r < height; ++r)
                trailing(rows[row_begin[s] + r] - interior_count, column - interior_count) =
                    values[value_begin[s] + static_cast<std::size_t>(column - super[s]) * height + r];
    }
    return trailing;
}

Index CondensedLaplacian::boundary_size() const { return static_cast<Index>(impl_->boundary.size()); }

MatrixXd CondensedLaplacian::sigma() const
{
    const MatrixXd product = lower_times_transpose(impl_->trailing);
    const Index m = static_cast<Index>(product.rows());
    MatrixXd result(m, m);
    for (Index j = 0; j < m; ++j)
        for (Index i = 0; i < m; ++i) {
            const Index p = impl_->position[i], q = impl_->position[j];
            result(i, j) = product(p, q);
        }
    result.diagonal().array() -= 1.0;
    return result;
}

MatrixXd CondensedLaplacian::Impl::solve(int system, const MatrixXd& right_hand_side)
{
    cholmod_dense b = view(right_hand_side);
    const Dense x = own(cholmod_solve(system, factor.get(), &b, common.get()), common);
    common.require(x != nullptr, "back-substitution");
    return to_eigen(*x);
}

bool CondensedLaplacian::has_sigma() const { return !impl_->interior; }

MatrixXd CondensedLaplacian::extend(const MatrixXd& boundary_values) const
{
    if (impl_->interior) {
        MatrixXd values = MatrixXd::Zero(impl_->vertex_count, boundary_values.cols());
        values(impl_->boundary, Eigen::all) = boundary_values;
        MatrixXd load = -(impl_->laplacian * values);
        load(impl_->boundary, Eigen::all) = boundary_values;
        return impl_->interior->solve(load);
    }
    // L' x = (0, L_BB' z_B) has x_B = z_B and x_I = -L_II^-T L_BI' z_B, the harmonic extension.
    const Index m = static_cast<Index>(impl_->position.size());
    MatrixXd z(m, boundary_values.cols());
    for (Index i = 0; i < m; ++i) z.row(impl_->position[i]) = boundary_values.row(i);
    MatrixXd load = MatrixXd::Zero(impl_->vertex_count, boundary_values.cols());
    load.bottomRows(m) = impl_->trailing.triangularView<Eigen::Lower>().transpose() * z;
    const MatrixXd solution = impl_->solve(CHOLMOD_Lt, load);

    MatrixXd result(impl_->vertex_count, boundary_values.cols());
    const Index* perm = static_cast<const Index*>(impl_->factor->Perm);
    for (Index j = 0; j < impl_->vertex_count; ++j) result.row(perm[j]) = solution.row(j);
    for (Index i = 0; i < m; ++i) result.row(impl_->boundary[i]) = boundary_values.row(i);
    return result;
}

InteriorSolution CondensedLaplacian::solve_interior(const VectorXd& load) const
{
    if (impl_->interior) {
        MatrixXd inner = load;
        for (const Index v : impl_->boundary) inner(v, 0) = 0.0;
        const VectorXd values = impl_->interior->solve(inner);
        return {values, -VectorXd(impl_->laplacian * values)(impl_->boundary)};
    }
    const Index* perm = static_cast<const Index*>(impl_->factor->Perm);
    const Index m = static_cast<Index>(impl_->position.size());
    MatrixXd permuted = MatrixXd::Zero(impl_->vertex_count, 1);
    for (Index j = 0; j < impl_->interior_count; ++j) permuted(j, 0) = load[perm[j]];

    // L y = (f, 0) gives y_I = L_II^-1 f and L_BB y_B = -L_BI y_I = -K_BI K_II^-1 f, the flux that arrives at B.
    MatrixXd half = impl_->solve(CHOLMOD_L, permuted);
    const VectorXd flux = impl_->trailing.triangularView<Eigen::Lower>() * half.col(0).tail(m);
    half.bottomRows(m).setZero();
    const MatrixXd solution = impl_->solve(CHOLMOD_Lt, half);

    InteriorSolution result{VectorXd(impl_->vertex_count), VectorXd(m)};
    for (Index j = 0; j < impl_->vertex_count; ++j) result.values[perm[j]] = solution(j, 0);
    for (Index i = 0; i < m; ++i) result.boundary_flux[i] = flux[impl_->position[i]];
    return result;
}

double CondensedLaplacian::factor_entries() const { return impl_->factor ? static_cast<double>(impl_->factor->xsize) : 0.0; }

}  // namespace koebe
