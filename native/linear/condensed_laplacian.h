// One factorization that gives both the Dirichlet-to-Neumann matrix of a surface and its Dirichlet solver.
#pragma once

#include "core/types.h"
#include "linear/sparse_cholesky.h"

#include <memory>
#include <vector>

namespace koebe {

/// u with K u = f inside and u = 0 on the boundary, and the flux of f that arrives at each boundary vertex.
struct InteriorSolution {
    VectorXd values;         ///< (V)
    VectorXd boundary_flux;  ///< (m), of the same sum as f
};

/// K + diag(0 on I, 1 on B) = L L' with the boundary B ordered last. The trailing block L_BB gives
/// Sigma = K_BB - K_BI K_II^-1 K_IB = L_BB L_BB' - 1, the leading part is the factor of K_II
/// (docs/method.md, "The condensed engine").
///
/// A part of the boundary can be grounded: it counts with the interior, but is held at 0, so that Sigma is of the rest
/// alone.
///
/// Of long boundaries nothing dense is kept. Then there is no Sigma, and the factor is that of K with disks in the
/// loops, the first one grounded, the others where AMD puts them: fill() takes other disks, and only what they reach is
/// computed anew. For K_II a large number takes the place of the disks.
class CondensedLaplacian {
public:
    /// @param laplacian (V, V) cotan Laplacian, both triangles stored
    /// @param boundary all boundary vertices; unused vertices must have been given a positive diagonal or be left out
    ///        of the matrix
    /// @param grounded so many of them, from the first on, are grounded; sigma() has the others, in their order
    /// @throws SolverError if K_II is not positive definite
    CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary, Index grounded = 0);

    /// Without a Sigma, to be filled. @param loops the whole boundary, two loops or more
    /// @throws SolverError if K is not positive definite where no disk reaches; if K_II is not elsewhere, extend() and
    /// solve_interior() give NaN
    CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops);
    ~CondensedLaplacian();
    CondensedLaplacian(CondensedLaplacian&&) noexcept;
    CondensedLaplacian& operator=(CondensedLaplacian&&) noexcept;

    /// The same of another Laplacian with the same pattern: of the surface with its vertices elsewhere.
    /// @throws SolverError as above; then this cannot be used any more
    void renew(const SparseMatrix& laplacian);

    /// Takes the boundary in another order from now on: what is given and returned goes by it.
    /// @param boundary the same vertices
    /// @return false, and nothing has changed, if a part of it is grounded
    bool reorder_boundary(const std::vector<Index>& boundary);

    /// Whether there is a sigma().
    bool has_sigma() const;

    /// Whether a part of the boundary is grounded.
    bool grounded() const;

    /// The Dirichlet-to-Neumann matrix of the boundary that is not grounded, symmetric and positive semidefinite; Sigma
    /// 1 = 0 if nothing is.
    MatrixXd sigma() const;

    /// What values on the grounded part draw from the others at 0: -Sigma_RG z. @param values (g, C)
    MatrixXd load_of_grounded(const MatrixXd& values) const;

    /// The flux into the grounded part from values on the others: -Sigma_GR u. @param values (m - g)
    VectorXd flux_to_grounded(const VectorXd& values) const;

    /// The factor of K with these symmetric blocks on all loops but the first, that one grounded and each entry of a
    /// block where its loop's vertices stand in the constructor's order; 1 in the place of what is grounded. Its last
    /// rows are the second loop's. Where there is no sigma(); good until the next call of any other function.
    /// @throws SolverError if that is not positive definite
    const SparseCholesky& fill(const std::vector<MatrixXd>& disks) const;

    Index boundary_size() const;

    /// Harmonic extension: (m, C) boundary values in the boundary's order -> (V, C) values at all vertices.
    MatrixXd extend(const MatrixXd& boundary_values) const;

    /// Solves K u = f with u = 0 on the boundary. @param load (V) f; values on the boundary are ignored
    InteriorSolution solve_interior(const VectorXd& load) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace koebe
