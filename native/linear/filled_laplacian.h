// The sparse factor of a surface with changing disks in its loops.
#pragma once

#include "core/types.h"
#include "linear/boundary_solver.h"
#include "linear/ground_columns.h"
#include "linear/sparse_cholesky.h"

#include <vector>

namespace koebe {

/// For long boundaries, where no dense matrix is kept. Factors K with disks in the loops. The first loop is grounded,
/// and the other loops are in AMD's order. fill() takes other disks, and recomputes only the rows that depend on them.
/// To factor K_II, a large number replaces the disks.
class FilledLaplacian final : public BoundarySolver {
public:
    /// @param laplacian (V, V) cotan Laplacian, stored with its upper and its lower triangle
    /// @param loops the whole boundary, two loops or more; it keeps its order
    /// @throws SolverError if K is not positive definite on rows that no disk reaches. If K_II is not positive definite
    /// on other rows, extend() and solve_interior() return NaN
    FilledLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops);

    void renew(const SparseMatrix& laplacian) override;
    bool reorder_boundary(const std::vector<Index>&) override { return false; }
    Index boundary_size() const override { return boundary_.size(); }
    MatrixXd extend(const MatrixXd& boundary_values) override;
    InteriorSolution solve_interior(const VectorXd& load) override;

    /// Factors K plus one symmetric block for each loop after the first, with rows in the constructor's order. The
    /// first loop is grounded, with 1 on the diagonal. The last rows of the factor are the second loop's. Any other
    /// call invalidates the factor.
    /// @throws SolverError if the sum is not positive definite
    const SparseCholesky& fill(const std::vector<MatrixXd>& disks);

private:
    void take_stiffness(const SparseMatrix& laplacian);
    MatrixXd solve_inside(MatrixXd load);

    std::vector<std::vector<Index>> loops_;
    GroundColumns boundary_;
    SparseCholesky cholesky_;
    std::vector<MatrixXd> stiff_;  // replace the disks, to hold the loops at 0
    bool is_filled_ = true;        // whether the factor is for disks
};

}  // namespace koebe
