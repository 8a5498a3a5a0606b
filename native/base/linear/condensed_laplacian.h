// One factorization for both the Dirichlet-to-Neumann matrix of a surface and its Dirichlet problems.
#pragma once

#include "core/types.h"
#include "linear/boundary_solver.h"
#include "linear/ground_columns.h"
#include "linear/sparse_cholesky.h"

#include <vector>

namespace koebe {

/// K + diag(0 on I, 1 on B) = L L' with the boundary B ordered last. The trailing block L_BB gives Sigma = K_BB - K_BI
/// K_II^-1 K_IB = L_BB L_BB' - 1, and the leading part is the factor of K_II (docs/method.md, "The condensed engine",
/// M5).
///
/// A part of the boundary can be grounded: this part is held at 0, and Sigma covers only the other boundary vertices.
/// Then the order of the boundary cannot change.
class CondensedLaplacian final : public BoundarySolver {
public:
    /// @param laplacian (V, V) cotan Laplacian, stored with its upper and its lower triangle
    /// @param boundary all boundary vertices; unused vertices need a positive diagonal, or are left out of the matrix
    /// @param grounded this many boundary vertices, from the first on, are grounded; sigma() has the others in their
    /// order
    /// @throws SolverError if K_II is not positive definite
    CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary, Index grounded = 0);

    void renew(const SparseMatrix& laplacian) override;
    bool reorder_boundary(const std::vector<Index>& boundary) override;
    Index boundary_size() const override;
    MatrixXd extend(const MatrixXd& boundary_values) override;
    InteriorSolution solve_interior(const VectorXd& load) override;

    /// Whether a part of the boundary is grounded.
    bool grounded() const { return ground_.size() > 0; }

    /// The Dirichlet-to-Neumann matrix of the boundary that is not grounded, symmetric and positive semidefinite.
    /// Without grounded vertices, Sigma 1 = 0.
    MatrixXd sigma() const;

    /// -Sigma_RG z: the load on the other boundary vertices, held at 0, from values on the grounded part. @param values
    /// (g, C)
    MatrixXd load_of_grounded(const MatrixXd& values) const;

    /// -Sigma_GR u: the flux into the grounded part from values on the other boundary vertices. @param values (m - g)
    VectorXd flux_to_grounded(const VectorXd& values) const;

private:
    SparseMatrix cut(const SparseMatrix& laplacian) const;

    GroundColumns ground_;
    std::vector<Index> kept_;  // the boundary that is not grounded, in the factor's order
    std::vector<Index> row_;   // row of each kept vertex in that order, if it differs from the boundary's
    SparseCholesky cholesky_;  // of K + diag(0, 1 where kept), with 1 on the diagonal of grounded vertices
};

}  // namespace koebe
