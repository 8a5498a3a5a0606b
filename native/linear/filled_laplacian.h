// The sparse factor of a surface with disks in its loops, which change.
#pragma once

#include "core/types.h"
#include "linear/boundary_solver.h"
#include "linear/ground_columns.h"
#include "linear/sparse_cholesky.h"

#include <vector>

namespace koebe {

/// For long boundaries, of which nothing dense is kept: the factor of K with disks in the loops, the first one
/// grounded, the others where AMD puts them. fill() takes other disks, and only what they reach is computed anew; for
/// K_II a large number takes the place of the disks.
class FilledLaplacian final : public BoundarySolver {
public:
    /// @param laplacian (V, V) cotan Laplacian, both triangles stored
    /// @param loops the whole boundary, two loops or more; it keeps its order
    /// @throws SolverError if K is not positive definite where no disk reaches; if K_II is not elsewhere, extend() and
    /// solve_interior() give NaN
    FilledLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops);

    void renew(const SparseMatrix& laplacian) override;
    bool reorder_boundary(const std::vector<Index>&) override { return false; }
    Index boundary_size() const override { return boundary_.size(); }
    MatrixXd extend(const MatrixXd& boundary_values) override;
    InteriorSolution solve_interior(const VectorXd& load) override;

    /// The factor of K with these symmetric blocks on all loops but the first, that one grounded and each entry of a
    /// block where its loop's vertices stand in the constructor's order; 1 in the place of what is grounded. Its last
    /// rows are the second loop's. Good until the next call of any other function.
    /// @throws SolverError if that is not positive definite
    const SparseCholesky& fill(const std::vector<MatrixXd>& disks);

private:
    void take_stiffness(const SparseMatrix& laplacian);
    MatrixXd solve_inside(MatrixXd load);

    std::vector<std::vector<Index>> loops_;
    GroundColumns boundary_;
    SparseCholesky cholesky_;
    std::vector<MatrixXd> stiff_;  // in place of the disks they hold the loops at 0
    bool is_filled_ = true;        // the factor is of disks
};

}  // namespace koebe
