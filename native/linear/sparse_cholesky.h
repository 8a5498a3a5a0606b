// Sparse Cholesky factorization on CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008), and a Dirichlet solve on it.
#pragma once

#include "core/types.h"

#include <memory>
#include <utility>
#include <vector>

namespace koebe {

/// Factor A = L L' of a symmetric positive definite matrix; supernodal, so that dense kernels do the work.
///
/// Some rows B can be kept to the end. Then the trailing block gives the Schur complement A_BB - A_BI A_II^-1 A_IB =
/// L_BB L_BB', and the leading part is the factor of A_II, I all other rows.
class SparseCholesky {
public:
    /// @param matrix symmetric: the lower triangle, or both
    /// @param last the rows B
    /// @param split_rows a larger matrix is cut into pieces that are factored side by side (factor/analysis.h)
    /// @throws SolverError if the matrix is not positive definite
    explicit SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last = {}, Index split_rows = 50000);

    /// Prepares the factors of A + blocks on some sets of rows, A = matrix; there is none before refactorize(blocks).
    /// @param changing the sets; A has an entry, if only an explicit 0, between any two rows of one
    SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last,
                   const std::vector<std::vector<Index>>& changing);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// Factor of another matrix with the same pattern; of A + blocks there is none then before refactorize(blocks).
    void refactorize(const SparseMatrix& matrix);

    /// Factor of A + symmetric blocks, one on each set that changes: only what they reach is computed anew.
    /// @throws SolverError if that is not positive definite
    void refactorize(const std::vector<MatrixXd>& blocks);

    /// Rows of the matrix.
    Index size() const;

    /// Solves for each column of the right-hand side.
    MatrixXd solve(const MatrixXd& right_hand_side) const;

    /// The Schur complement on B, its rows in the order in which B was given.
    MatrixXd last_schur() const;

    /// x with the given values on B, (b, C), and (A x)_I = f_I: (n, C). @param f (n, C), not read on B; empty: 0
    MatrixXd extend(const MatrixXd& last_values, const MatrixXd& f = {}) const;

    /// The rows of A^-1 f that are wanted, (wanted, C): the fewer those and the fewer f is not 0 on, the cheaper.
    MatrixXd solve_for(const std::vector<Index>& wanted, const MatrixXd& f) const;

    /// The rows of extend(last_values) that are wanted.
    MatrixXd extend_to(const std::vector<Index>& wanted, const MatrixXd& last_values) const;

    /// -A_BI A_II^-1 f_I, in the order of B: (b, C). @param f (n, C), not read on B
    MatrixXd flux_to_last(const MatrixXd& f) const;

    /// x with (A x)_I = f_I and x = 0 on B, and -(A x)_B, in the order of B. @param f (n), not read on B
    std::pair<VectorXd, VectorXd> solve_inner(const VectorXd& f) const;

    /// The blocks of A^-1 of sets of rows between any two of which A has an entry, if only an explicit 0: by selected
    /// inversion, at about twice the cost of the factorization.
    std::vector<MatrixXd> inverse_blocks(const std::vector<std::vector<Index>>& sets) const;

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
    std::vector<Index> free_;  // vertices solved for
    std::vector<Index> fixed_;
    SparseMatrix coupling_;  // K_IB
    std::unique_ptr<SparseCholesky> cholesky_;
};

}  // namespace koebe
