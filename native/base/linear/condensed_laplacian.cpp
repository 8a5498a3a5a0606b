#include "linear/condensed_laplacian.h"

#include "execution/thread_share.h"

#include <utility>

namespace koebe {
namespace {

constexpr std::size_t columns_at_a_time = 32768;  // columns per thread

/// K on the other vertices, the unit matrix on cut vertices, nothing between them. The pattern does not depend on the
/// values.
SparseMatrix with_cut_vertices(const SparseMatrix& laplacian, const std::vector<char>& is_cut)
{
    SparseMatrix result(laplacian.rows(), laplacian.cols());
    Index* const begin = result.outerIndexPtr();
    const auto each_column = [&](const auto& work) {
        in_pieces(is_cut.size(), columns_at_a_time, [&](std::size_t from, std::size_t until) {
            for (Index column = static_cast<Index>(from); column < static_cast<Index>(until); ++column) work(column);
        });
    };
    // Count, then fill: columns can then be filled side by side.
    each_column([&](Index column) {
        Index count = is_cut[column] ? 1 : 0;
        if (!is_cut[column])
            for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it) count += is_cut[it.row()] ? 0 : 1;
        begin[column + 1] = count;
    });
    for (std::size_t column = 0; column < is_cut.size(); ++column) begin[column + 1] += begin[column];
    result.resizeNonZeros(begin[is_cut.size()]);
    each_column([&](Index column) {
        Index* row = result.innerIndexPtr() + begin[column];
        double* value = result.valuePtr() + begin[column];
        if (is_cut[column]) {
            *row = column;
            *value = 1.0;
            return;
        }
        for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it)
            if (!is_cut[it.row()]) {
                *row++ = static_cast<Index>(it.row());
                *value++ = it.value();
            }
    });
    return result;
}

MatrixXd reordered(const MatrixXd& rows, const std::vector<Index>& row)
{
    if (row.empty()) return rows;
    MatrixXd result(rows.rows(), rows.cols());
    result(row, Eigen::all) = rows;
    return result;
}

}  // namespace

CondensedLaplacian::CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary,
                                       Index grounded)
    : ground_(laplacian, {boundary.begin(), boundary.begin() + grounded}),
      kept_(boundary.begin() + grounded, boundary.end()),
      cholesky_(grounded ? SparseCholesky(cut(laplacian), kept_, SparseCholesky::most_in_one_piece, 1.0)
                         : SparseCholesky(laplacian, kept_, SparseCholesky::most_in_one_piece, 1.0))
{
}

/// K without the grounded vertices.
SparseMatrix CondensedLaplacian::cut(const SparseMatrix& laplacian) const
{
    std::vector<char> is_cut(laplacian.rows(), 0);
    for (const Index v : ground_.vertices()) is_cut[v] = 1;
    return with_cut_vertices(laplacian, is_cut);
}

void CondensedLaplacian::renew(const SparseMatrix& laplacian)
{
    ground_.renew(laplacian);
    if (grounded())
        cholesky_.refactorize(cut(laplacian));
    else
        cholesky_.refactorize(laplacian);
}

bool CondensedLaplacian::reorder_boundary(const std::vector<Index>& boundary)
{
    if (grounded()) return false;
    std::vector<Index> place(cholesky_.size(), -1);
    for (std::size_t i = 0; i < kept_.size(); ++i) place[kept_[i]] = static_cast<Index>(i);
    row_.clear();
    for (const Index v : boundary) row_.push_back(place[v]);
    return true;
}

Index CondensedLaplacian::boundary_size() const { return ground_.size() + static_cast<Index>(kept_.size()); }

MatrixXd CondensedLaplacian::sigma() const
{
    MatrixXd result = cholesky_.last_schur();
    result.diagonal().array() -= 1.0;
    return row_.empty() ? result : MatrixXd(result(row_, row_));
}

MatrixXd CondensedLaplacian::load_of_grounded(const MatrixXd& values) const
{
    const MatrixXd load = ground_.load(values);
    return cholesky_.flux_to_last(load) + load(kept_, Eigen::all);
}

VectorXd CondensedLaplacian::flux_to_grounded(const VectorXd& values) const
{
    return ground_.flux(cholesky_.extend(values));
}

MatrixXd CondensedLaplacian::extend(const MatrixXd& boundary_values)
{
    if (!grounded()) return cholesky_.extend(reordered(boundary_values, row_));
    return cholesky_.extend(boundary_values.bottomRows(boundary_values.rows() - ground_.size()),
                            ground_.load(boundary_values.topRows(ground_.size())));
}

InteriorSolution CondensedLaplacian::solve_interior(const VectorXd& load)
{
    VectorXd inner = load;
    inner(ground_.vertices()).setZero();
    auto [values, flux] = cholesky_.solve_inner(inner);
    if (!grounded()) return {std::move(values), row_.empty() ? std::move(flux) : VectorXd(flux(row_))};
    VectorXd boundary_flux(boundary_size());
    boundary_flux << ground_.flux(values), flux;
    return {std::move(values), std::move(boundary_flux)};
}

}  // namespace koebe
