// Dirichlet problems on a surface whose boundary is given.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// u with K u = f inside and u = 0 on the boundary, and the flux of f that arrives at each boundary vertex.
struct InteriorSolution {
    VectorXd values;         ///< (V)
    VectorXd boundary_flux;  ///< (m), of the same sum as f
};

/// A factorization of a surface's Laplacian K that solves for the interior. The boundary's order is that in which it
/// was given.
class BoundarySolver {
public:
    BoundarySolver() = default;
    BoundarySolver(BoundarySolver&&) noexcept = default;
    BoundarySolver& operator=(BoundarySolver&&) noexcept = default;
    virtual ~BoundarySolver() = default;

    /// The same of another Laplacian with the same pattern: of the surface with its vertices elsewhere.
    /// @throws SolverError as the constructor; then this cannot be used any more
    virtual void renew(const SparseMatrix& laplacian) = 0;

    /// Takes the boundary in another order from now on: what is given and returned goes by it.
    /// @param boundary the same vertices
    /// @return false, and nothing has changed, if it cannot
    virtual bool reorder_boundary(const std::vector<Index>& boundary) = 0;

    virtual Index boundary_size() const = 0;

    /// Harmonic extension: (m, C) boundary values in the boundary's order -> (V, C) values at all vertices.
    virtual MatrixXd extend(const MatrixXd& boundary_values) = 0;

    /// Solves K u = f with u = 0 on the boundary. @param load (V) f; values on the boundary are ignored
    virtual InteriorSolution solve_interior(const VectorXd& load) = 0;
};

}  // namespace koebe
