// Dirichlet problems on a surface with given boundary.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// u with K u = f inside and u = 0 on the boundary, and the flux of f that arrives at each boundary vertex.
struct InteriorSolution {
    VectorXd values;         ///< (V)
    VectorXd boundary_flux;  ///< (m), with the same sum as f
};

/// A factorization of a surface's Laplacian K that solves for the interior. The boundary keeps the order in which it
/// was given.
class BoundarySolver {
public:
    BoundarySolver() = default;
    BoundarySolver(BoundarySolver&&) noexcept = default;
    BoundarySolver& operator=(BoundarySolver&&) noexcept = default;
    virtual ~BoundarySolver() = default;

    /// Factors the Laplacian of the same surface with moved vertices. The Laplacian must have the same pattern.
    /// @throws SolverError like the constructor; the solver is unusable afterwards
    virtual void renew(const SparseMatrix& laplacian) = 0;

    /// Takes the boundary vertices in another order from now on, for arguments and results.
    /// @param boundary the same vertices
    /// @return false if the solver cannot change the order; then nothing has changed
    virtual bool reorder_boundary(const std::vector<Index>& boundary) = 0;

    virtual Index boundary_size() const = 0;

    /// Harmonic extension: (m, C) boundary values in the boundary's order -> (V, C) values at all vertices.
    virtual MatrixXd extend(const MatrixXd& boundary_values) = 0;

    /// Solves K u = f with u = 0 on the boundary. @param load (V) f; values on the boundary are ignored
    virtual InteriorSolution solve_interior(const VectorXd& load) = 0;
};

}  // namespace koebe
