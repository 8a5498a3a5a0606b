#include "linear/filled_laplacian.h"

#include "core/errors.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double stiffness = 1e20;  // over the largest diagonal entry: its inverse vanishes beside rounding

/// The lower triangle of K without the first loop, with an entry between any two vertices of each other loop.
SparseMatrix with_room_for_disks(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops)
{
    constexpr Index none = -1, first = 0;
    std::vector<Index> loop_of(laplacian.rows(), none);
    std::vector<std::vector<Index>> sorted = loops;
    std::ptrdiff_t entries = laplacian.nonZeros();
    for (std::size_t k = 0; k < loops.size(); ++k) {
        for (const Index v : loops[k]) loop_of[v] = static_cast<Index>(k);
        std::sort(sorted[k].begin(), sorted[k].end());
        entries += static_cast<std::ptrdiff_t>(loops[k].size() * loops[k].size());
    }
    SparseMatrix result(laplacian.rows(), laplacian.cols());
    result.reserve(entries);
    for (Index v = 0; v < static_cast<Index>(laplacian.cols()); ++v) {
        result.startVec(v);
        if (loop_of[v] == first) {
            result.insertBack(v, v) = 1.0;
            continue;
        }
        auto room = sorted[first].end();
        const auto end = loop_of[v] == none ? room : sorted[loop_of[v]].end();
        if (loop_of[v] != none) room = std::lower_bound(sorted[loop_of[v]].begin(), end, v);
        for (SparseMatrix::InnerIterator it(laplacian, v); it; ++it) {
            const Index row = static_cast<Index>(it.row());
            if (row < v || loop_of[row] == first) continue;
            for (; room != end && *room < row; ++room) result.insertBack(*room, v) = 0.0;
            if (room != end && *room == row) ++room;
            result.insertBack(row, v) = it.value();
        }
        for (; room != end; ++room) result.insertBack(*room, v) = 0.0;
    }
    result.finalize();
    return result;
}

std::vector<Index> joined(const std::vector<std::vector<Index>>& loops)
{
    std::vector<Index> all;
    for (const std::vector<Index>& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
    return all;
}

}  // namespace

FilledLaplacian::FilledLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops)
    : loops_(loops),
      boundary_(laplacian, joined(loops)),
      cholesky_(with_room_for_disks(laplacian, loops), loops[1], std::vector(loops.begin() + 1, loops.end()))
{
    take_stiffness(laplacian);
}

void FilledLaplacian::renew(const SparseMatrix& laplacian)
{
    boundary_.renew(laplacian);
    cholesky_.refactorize(with_room_for_disks(laplacian, loops_));
    take_stiffness(laplacian);
}

void FilledLaplacian::take_stiffness(const SparseMatrix& laplacian)
{
    const double value = stiffness * laplacian.diagonal().maxCoeff();
    stiff_.clear();
    for (std::size_t k = 1; k < loops_.size(); ++k)
        stiff_.push_back(value * MatrixXd::Identity(loops_[k].size(), loops_[k].size()));
    is_filled_ = true;
}

const SparseCholesky& FilledLaplacian::fill(const std::vector<MatrixXd>& disks)
{
    is_filled_ = true;
    cholesky_.refactorize(disks);
    return cholesky_;
}

/// Solves K_II u_I = f_I. Boundary entries are undefined. Returns NaN if K_II is not positive definite.
MatrixXd FilledLaplacian::solve_inside(MatrixXd load)
{
    load(boundary_.vertices(), Eigen::all).setZero();
    try {
        if (is_filled_) cholesky_.refactorize(stiff_);
    } catch (const OutOfMemory&) {
        throw;
    } catch (const SolverError&) {
        return MatrixXd::Constant(load.rows(), load.cols(), std::numeric_limits<double>::quiet_NaN());
    }
    is_filled_ = false;
    std::vector<Index> all(load.rows());
    std::iota(all.begin(), all.end(), 0);
    return cholesky_.solve_for(all, load);
}

MatrixXd FilledLaplacian::extend(const MatrixXd& boundary_values)
{
    MatrixXd result = solve_inside(boundary_.load(boundary_values));
    result(boundary_.vertices(), Eigen::all) = boundary_values;
    return result;
}

InteriorSolution FilledLaplacian::solve_interior(const VectorXd& load)
{
    VectorXd values = solve_inside(load);
    values(boundary_.vertices()).setZero();
    return {values, boundary_.flux(values)};
}

}  // namespace koebe
