#include "geometry/condensed_laplacian.h"

namespace koebe {

namespace {

/// K on the interior, the unit matrix on the boundary, nothing between them.
SparseMatrix cut_off(const SparseMatrix& laplacian, const std::vector<char>& on_boundary)
{
    SparseMatrix result = laplacian;
    for (Index column = 0; column < static_cast<Index>(result.cols()); ++column)
        for (SparseMatrix::InnerIterator it(result, column); it; ++it)
            if (on_boundary[it.row()] || on_boundary[column]) it.valueRef() = it.row() == column ? 1.0 : 0.0;
    result.prune([](Index, Index, double value) { return value != 0.0; });
    return result;
}

}  // namespace

struct CondensedLaplacian::Impl {
    std::vector<Index> boundary;
    // With Sigma: the factor of K + diag(0, 1). Without: that of K with the boundary cut off it, 1 in its place.
    std::unique_ptr<SparseCholesky> cholesky;
    bool has_sigma = true;
    SparseMatrix laplacian;         // K, without Sigma only, as is
    std::vector<char> on_boundary;
};

CondensedLaplacian::CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary,
                                       Ordering ordering, std::size_t most_condensed)
    : impl_(std::make_unique<Impl>())
{
    impl_->boundary = boundary;
    impl_->has_sigma = boundary.size() <= most_condensed;
    if (impl_->has_sigma) {
        SparseMatrix shifted = laplacian;
        for (const Index v : boundary) shifted.coeffRef(v, v) += 1.0;
        impl_->cholesky = std::make_unique<SparseCholesky>(shifted, ordering, boundary);
    } else {
        impl_->laplacian = laplacian;
        impl_->on_boundary.assign(laplacian.rows(), 0);
        for (const Index v : boundary) impl_->on_boundary[v] = 1;
        impl_->cholesky = std::make_unique<SparseCholesky>(cut_off(laplacian, impl_->on_boundary), ordering);
    }
}

CondensedLaplacian::~CondensedLaplacian() = default;
CondensedLaplacian::CondensedLaplacian(CondensedLaplacian&&) noexcept = default;
CondensedLaplacian& CondensedLaplacian::operator=(CondensedLaplacian&&) noexcept = default;

Index CondensedLaplacian::boundary_size() const { return static_cast<Index>(impl_->boundary.size()); }

bool CondensedLaplacian::has_sigma() const { return impl_->has_sigma; }

MatrixXd CondensedLaplacian::sigma() const
{
    MatrixXd result = impl_->cholesky->last_schur();
    result.diagonal().array() -= 1.0;
    return result;
}

/// K_PP 1 - K_PI K_II^-1 K_IP 1.
VectorXd CondensedLaplacian::flux_of_part(const std::vector<Index>& part) const
{
    const SparseMatrix& laplacian = impl_->laplacian;
    VectorXd indicator = VectorXd::Zero(laplacian.rows());
    for (const Index v : part) indicator[v] = 1.0;
    SparseMatrix coupling(laplacian.rows(), part.size());  // K_IP
    VectorXd flux = VectorXd::Zero(part.size());
    for (std::size_t c = 0; c < part.size(); ++c) {
        coupling.startVec(c);
        for (SparseMatrix::InnerIterator it(laplacian, part[c]); it; ++it) {
            flux[c] += it.value() * indicator[it.row()];
            if (!impl_->on_boundary[it.row()]) coupling.insertBack(it.row(), c) = it.value();
        }
    }
    coupling.finalize();
    return flux - impl_->cholesky->inverse_form_sum(coupling);
}

MatrixXd CondensedLaplacian::extend(const MatrixXd& boundary_values) const
{
    if (impl_->has_sigma) return impl_->cholesky->extend(boundary_values);
    MatrixXd values = MatrixXd::Zero(impl_->laplacian.rows(), boundary_values.cols());
    values(impl_->boundary, Eigen::all) = boundary_values;
    MatrixXd load = -(impl_->laplacian * values);
    load(impl_->boundary, Eigen::all) = boundary_values;
    return impl_->cholesky->solve(load);
}

InteriorSolution CondensedLaplacian::solve_interior(const VectorXd& load) const
{
    if (impl_->has_sigma) {
        auto [values, flux] = impl_->cholesky->solve_inner(load);
        return {std::move(values), std::move(flux)};
    }
    MatrixXd inner = load;
    for (const Index v : impl_->boundary) inner(v, 0) = 0.0;
    const VectorXd values = impl_->cholesky->solve(inner);
    return {values, -VectorXd(impl_->laplacian * values)(impl_->boundary)};
}

}  // namespace koebe
