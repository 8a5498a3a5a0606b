// One factorization that gives both the Dirichlet-to-Neumann matrix of a surface and its Dirichlet solver.
#pragma once

#include "core/types.h"
#include "linear/boundary_solver.h"
#include "linear/ground_columns.h"
#include "linear/sparse_cholesky.h"

#include <vector>

namespace koebe {

/// K + diag(0 on I, 1 on B) = L L' with the boundary B ordered last. The trailing block L_BB gives
/// Sigma = K_BB - K_BI K_II^-1 K_IB = L_BB L_BB' - 1, the leading part is the factor of K_II
/// (docs/method.md, "The condensed engine").
///
/// A part of the boundary can be grounded: it counts with the interior, but is held at 0, so that Sigma is of the rest
/// alone. Then the boundary keeps its order.
class CondensedLaplacian final : public BoundarySolver {
public:
    /// @param laplacian (V, V) cotan Laplacian, both triangles stored
    /// @param boundary all boundary vertices; unused vertices must have been given a positive diagonal or be left out
    ///        of the matrix
    /// @param grounded so many of them, from the first on, are grounded; sigma() has the others, in their order
    /// @throws SolverError if K_II is not positive definite
    CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary, Index grounded = 0);

    void renew(const SparseMatrix& laplacian) override;
    bool reorder_boundary(const std::vector<Index>& boundary) override;
    Index boundary_size() const override;
    MatrixXd extend(const MatrixXd& boundary_values) override;
    InteriorSolution solve_interior(const VectorXd& load) override;

    /// Whether a part of the boundary is grounded.
    bool grounded() const { return ground_.size() > 0; }

    /// The Dirichlet-to-Neumann matrix of the boundary that is not grounded, symmetric and positive semidefinite; Sigma
    /// 1 = 0 if nothing is.
    MatrixXd sigma() const;

    /// What values on the grounded part draw from the others at 0: -Sigma_RG z. @param values (g, C)
    MatrixXd load_of_grounded(const MatrixXd& values) const;

    /// The flux into the grounded part from values on the others: -Sigma_GR u. @param values (m - g)
    VectorXd flux_to_grounded(const VectorXd& values) const;

private:
    SparseMatrix shifted(const SparseMatrix& laplacian) const;

    GroundColumns ground_;
    std::vector<Index> kept_;  // the rest of the boundary, in the factor's order
    std::vector<Index> row_;   // of each kept vertex in that order, where the boundary's is another
    SparseCholesky cholesky_;  // of K + diag(0, 1 where kept), 1 in the place of what is grounded
};

}  // namespace koebe
