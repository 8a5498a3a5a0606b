#include "tiles/floating_loops.h"

#include "core/errors.h"
#include "linear/sparse_cholesky.h"

namespace koebe {

FloatingLoops::FloatingLoops(const PeriodicSurface& domain, bool holes_float)
    : domain_(domain), representative_(domain.surface.vertex_count)
{
    for (Index v = 0; v < domain.surface.vertex_count; ++v) representative_[v] = v;
    for (std::size_t k = domain.first_hole; holes_float && k < domain.loops.size(); ++k)
        for (const Index v : domain.loops[k]) representative_[v] = domain.loops[k].front();
    std::vector<Index> number(representative_.size(), -1);
    for (std::size_t v = 0; v < representative_.size(); ++v)
        if (representative_[v] == static_cast<Index>(v)) number[v] = count_++;
    for (Index& v : representative_) v = number[v];
    const SparseMatrix laplacian = laplacian_of(domain);
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index c = 0; c < static_cast<Index>(laplacian.cols()); ++c)
        for (SparseMatrix::InnerIterator it(laplacian, c); it; ++it)
            entries.emplace_back(representative_[it.row()], representative_[c], it.value());
    matrix_.resize(count_, count_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
}

VectorXd FloatingLoops::between_rims() const
{
    std::vector<char> fixed(static_cast<std::size_t>(count_), 0);
    MatrixXd values = MatrixXd::Zero(count_, 1);
    for (int rim = 0; rim < 2; ++rim)
        for (const Index v : domain_.loops[rim]) {
            fixed[representative_[v]] = 1;
            values(representative_[v], 0) = rim;
        }
    return spread(DirichletSolver(matrix_, fixed).solve(values).col(0));
}

VectorXd FloatingLoops::round() const
{
    const VectorXd load = jump_load(domain_, domain_.metric_shifts[0]);
    MatrixXd sums = MatrixXd::Zero(count_, 1);
    for (Index v = 0; v < static_cast<Index>(load.size()); ++v) sums(representative_[v], 0) += load[v];
    // One vertex is tied to 0. Constants are in the kernel, so the tie draws nothing.
    SparseMatrix tied = matrix_;
    tied.coeffRef(0, 0) += matrix_.diagonal().mean();
    return spread(SparseCholesky(tied).solve(sums).col(0));
}

VectorXd FloatingLoops::spread(const VectorXd& values) const
{
    if (!values.allFinite()) throw SolverError("no finite harmonic function: the metric is degenerate");
    return values(representative_);
}

}  // namespace koebe
