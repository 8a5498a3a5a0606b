// Sparse Cholesky factorization on CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008), and a Dirichlet solve on it.
#pragma once

#include "core/types.h"

#include <memory>
#include <vector>

namespace koebe {

enum class Ordering { amd, metis };

/// Factor of a symmetric positive definite matrix; supernodal, so that dense kernels do the work.
class SparseCholesky {
public:
    /// @param matrix symmetric, of which the lower triangle is read
    /// @throws SolverError if the matrix is not positive definite
    explicit SparseCholesky(const SparseMatrix& matrix, Ordering ordering = Ordering::amd);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// Factor of another matrix with the same pattern.
    void refactorize(const SparseMatrix& matrix);

    /// Solves for each column of the right-hand side.
    MatrixXd solve(const MatrixXd& right_hand_side) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Harmonic functions with given values on a set of vertices: K_II u_I = -K_IB u_B (paper, equation 2).
class DirichletSolver {
public:
    /// @param laplacian both triangles stored
    /// @param fixed (V) 1 where the value is given
    DirichletSolver(const SparseMatrix& laplacian, const std::vector<char>& fixed);

    /// @param values (V, C) one harmonic function a column; rows of free vertices are ignored
    /// @return (V, C) harmonic at the free vertices, equal to the given values at the fixed ones
    MatrixXd solve(const MatrixXd& values) const;

private:
    std::vector<Index> free_;       // vertices solved for
    std::vector<Index> fixed_;
    SparseMatrix coupling_;         // K_IB
    std::unique_ptr<SparseCholesky> cholesky_;
};

}  // namespace koebe
