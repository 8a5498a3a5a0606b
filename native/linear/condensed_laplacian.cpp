#include "linear/condensed_laplacian.h"

#include <utility>

namespace koebe {

namespace {

/// K on the interior, the unit matrix where something is cut off, nothing between them; 1 more on the diagonal of what
/// is kept to the end. The pattern does not depend on the values.
SparseMatrix shifted_and_cut(const SparseMatrix& laplacian, const std::vector<char>& is_cut,
                             const std::vector<Index>& kept)
{
    std::vector<char> is_kept(laplacian.rows(), 0);
    for (const Index v : kept) is_kept[v] = 1;
    SparseMatrix result(laplacian.rows(), laplacian.cols());
    result.reserve(laplacian.nonZeros());
    for (Index column = 0; column < static_cast<Index>(laplacian.cols()); ++column) {
        result.startVec(column);
        if (is_cut[column]) {
            result.insertBack(column, column) = 1.0;
            continue;
        }
        for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it)
            if (!is_cut[it.row()])
                result.insertBack(it.row(), column) = it.value() + (is_kept[column] && it.row() == column ? 1.0 : 0.0);
    }
    result.finalize();
    return result;
}

}  // namespace

struct CondensedLaplacian::Impl {
    SparseMatrix laplacian;  // K, where something is cut off
    Index vertex_count = 0;
    std::vector<Index> ground, kept;           // the two parts of the boundary, in the factor's order
    std::vector<char> is_cut;                  // the grounded vertices, or without Sigma all boundary vertices
    std::unique_ptr<SparseCholesky> cholesky;  // of K + diag(0, 1 where kept), 1 in the place of what is cut off
    bool has_sigma = true;
    std::vector<Index> row;  // of each kept vertex in the factor's order, where that is another

    /// What is factored of a Laplacian: 1 added to the diagonal where kept, the grounded part cut off.
    SparseMatrix shifted(const SparseMatrix& matrix) const
    {
        if (!is_cut.empty()) return shifted_and_cut(matrix, is_cut, kept);
        SparseMatrix result = matrix;
        for (const Index v : kept) result.coeffRef(v, v) += 1.0;
        return result;
    }

    /// Rows in the factor's order as the boundary is given now.
    template <typename Matrix>
    Matrix as_given(Matrix rows) const
    {
        return row.empty() ? rows : Matrix(rows(row, Eigen::all));
    }

    MatrixXd as_factored(const MatrixXd& rows) const
    {
        if (row.empty()) return rows;
        MatrixXd result(rows.rows(), rows.cols());
        result(row, Eigen::all) = rows;
        return result;
    }

    /// -K z for values on the grounded part, and the values themselves there.
    MatrixXd load(const MatrixXd& ground_values) const
    {
        MatrixXd z = MatrixXd::Zero(laplacian.rows(), ground_values.cols());
        z(ground, Eigen::all) = ground_values;
        MatrixXd result = -(laplacian * z);
        result(ground, Eigen::all) = ground_values;
        return result;
    }
};

CondensedLaplacian::CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary,
                                       Ordering ordering, Index grounded, std::size_t most_condensed)
    : impl_(std::make_unique<Impl>())
{
    impl_->vertex_count = static_cast<Index>(laplacian.rows());
    impl_->has_sigma = boundary.size() - grounded <= most_condensed;
    if (!impl_->has_sigma) grounded = static_cast<Index>(boundary.size());
    impl_->ground.assign(boundary.begin(), boundary.begin() + grounded);
    impl_->kept.assign(boundary.begin() + grounded, boundary.end());
    if (grounded > 0) {
        impl_->laplacian = laplacian;
        impl_->is_cut.assign(laplacian.rows(), 0);
        for (const Index v : impl_->ground) impl_->is_cut[v] = 1;
    }
    impl_->cholesky = std::make_unique<SparseCholesky>(impl_->shifted(laplacian), ordering, impl_->kept);
}

void CondensedLaplacian::renew(const SparseMatrix& laplacian)
{
    if (!impl_->is_cut.empty()) impl_->laplacian = laplacian;
    impl_->cholesky->refactorize(impl_->shifted(laplacian));
}

CondensedLaplacian::~CondensedLaplacian() = default;
CondensedLaplacian::CondensedLaplacian(CondensedLaplacian&&) noexcept = default;
CondensedLaplacian& CondensedLaplacian::operator=(CondensedLaplacian&&) noexcept = default;

Index CondensedLaplacian::boundary_size() const
{
    return static_cast<Index>(impl_->ground.size() + impl_->kept.size());
}

bool CondensedLaplacian::reorder_boundary(const std::vector<Index>& boundary)
{
    if (!impl_->has_sigma) {
        impl_->ground = boundary;
        return true;
    }
    if (grounded()) return false;
    std::vector<Index> place(impl_->vertex_count, -1);
    for (std::size_t i = 0; i < impl_->kept.size(); ++i) place[impl_->kept[i]] = static_cast<Index>(i);
    impl_->row.clear();
    for (const Index v : boundary) impl_->row.push_back(place[v]);
    return true;
}

bool CondensedLaplacian::has_sigma() const { return impl_->has_sigma; }

bool CondensedLaplacian::grounded() const { return impl_->has_sigma && !impl_->ground.empty(); }

MatrixXd CondensedLaplacian::sigma() const
{
    MatrixXd result = impl_->cholesky->last_schur();
    result.diagonal().array() -= 1.0;
    return impl_->row.empty() ? result : MatrixXd(result(impl_->row, impl_->row));
}

MatrixXd CondensedLaplacian::load_of_grounded(const MatrixXd& values) const
{
    const MatrixXd load = impl_->load(values);
    return impl_->cholesky->flux_to_last(load) + load(impl_->kept, Eigen::all);
}

VectorXd CondensedLaplacian::flux_to_grounded(const VectorXd& values) const
{
    const VectorXd u = impl_->cholesky->extend(values);
    return -VectorXd(impl_->laplacian * u)(impl_->ground);
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
            if (!impl_->is_cut[it.row()]) coupling.insertBack(it.row(), c) = it.value();
        }
    }
    coupling.finalize();
    return flux - impl_->cholesky->inverse_form_sum(coupling);
}

MatrixXd CondensedLaplacian::extend(const MatrixXd& boundary_values) const
{
    const Eigen::Index grounded = static_cast<Eigen::Index>(impl_->ground.size());
    if (grounded == 0) return impl_->cholesky->extend(impl_->as_factored(boundary_values));
    return impl_->cholesky->extend(boundary_values.bottomRows(boundary_values.rows() - grounded),
                                   impl_->load(boundary_values.topRows(grounded)));
}

InteriorSolution CondensedLaplacian::solve_interior(const VectorXd& load) const
{
    VectorXd inner = load;
    inner(impl_->ground).setZero();
    auto [values, flux] = impl_->cholesky->solve_inner(inner);
    if (impl_->ground.empty()) return {std::move(values), impl_->as_given(std::move(flux))};
    VectorXd boundary_flux(boundary_size());
    boundary_flux << -VectorXd(impl_->laplacian * values)(impl_->ground), flux;
    return {std::move(values), std::move(boundary_flux)};
}

}  // namespace koebe
