#include "linear/ground_columns.h"

#include "core/numbering.h"

#include <algorithm>
#include <utility>

namespace koebe {

GroundColumns::GroundColumns(const SparseMatrix& laplacian, std::vector<Index> vertices)
    : vertices_(std::move(vertices))
{
    renew(laplacian);
}

void GroundColumns::renew(const SparseMatrix& laplacian)
{
    if (vertices_.empty()) return;
    SparseMatrix columns(laplacian.rows(), static_cast<Eigen::Index>(vertices_.size()));
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        columns.startVec(static_cast<Eigen::Index>(i));
        for (SparseMatrix::InnerIterator it(laplacian, vertices_[i]); it; ++it)
            columns.insertBack(it.row(), static_cast<Eigen::Index>(i)) = it.value();
    }
    columns.finalize();
    columns_.swap(columns);
}

MatrixXd GroundColumns::load(const MatrixXd& values) const
{
    std::vector<Index> order = numbers_below(vertices_.size());
    std::ranges::sort(order, {}, [&](Index i) { return vertices_[i]; });
    MatrixXd result = MatrixXd::Zero(columns_.rows(), values.cols());
    for (const Index i : order)
        for (SparseMatrix::InnerIterator it(columns_, i); it; ++it) result.row(it.row()) -= it.value() * values.row(i);
    result(vertices_, Eigen::all) = values;
    return result;
}

VectorXd GroundColumns::flux(const VectorXd& u) const
{
    VectorXd result = VectorXd::Zero(size());
    for (Index i = 0; i < size(); ++i)
        for (SparseMatrix::InnerIterator it(columns_, i); it; ++it) result[i] -= it.value() * u[it.row()];
    return result;
}

}  // namespace koebe
