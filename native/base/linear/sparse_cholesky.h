// Sparse Cholesky factorization on CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008), and a Dirichlet solver on it.
#pragma once

#include "core/types.h"

#include <memory>
#include <utility>
#include <vector>

namespace koebe {

/// Factor A = L L' of a symmetric positive definite matrix. It is supernodal: dense kernels do the work.
///
/// Some rows B can be kept to the end. Then the trailing block gives the Schur complement A_BB - A_BI A_II^-1 A_IB =
/// L_BB L_BB', and the leading part is the factor of A_II. I are all other rows.
class SparseCholesky {
public:
    static constexpr Index most_in_one_piece = 50000;  ///< rows

    /// @param matrix symmetric: the lower triangle, or both triangles @param last the rows B
    /// @param split_rows a matrix with more rows is cut into pieces that are factored side by side (factor/analysis.h)
    /// @param shift is added to the diagonal of B, so that no copy of the matrix is needed
    /// @throws SolverError if the sum is not positive definite
    explicit SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last = {},
                            Index split_rows = most_in_one_piece, double shift = 0.0);

    /// Prepares factors of A + blocks on some sets of rows, A = matrix. refactorize(blocks) makes the first factor.
    /// @param changing the sets; A has an entry, if only an explicit 0, between any two rows of a set
    /// @param by_fill whether the order weighs the fill in B (factor/elimination_order.h)
    SparseCholesky(const SparseMatrix& matrix, const std::vector<Index>& last,
                   const std::vector<std::vector<Index>>& changing, bool by_fill);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    /// Factors another matrix with the same pattern and the same shift. With changing blocks there is no factor until
    /// refactorize(blocks).
    void refactorize(const SparseMatrix& matrix);

    /// Factors A + symmetric blocks, one for each set that changes. Only the supernodes that depend on the blocks are
    /// recomputed.
    /// @throws SolverError if the sum is not positive definite
    void refactorize(const std::vector<MatrixXd>& blocks);

    /// Rows of the matrix.
    Index size() const;

    /// Solves for each column of the right-hand side.
    MatrixXd solve(const MatrixXd& right_hand_side) const;

    /// The Schur complement on B, with its rows in the order in which B was given.
    MatrixXd last_schur() const;

    /// x with the given values on B, (b, C), and (A x)_I = f_I: (n, C). @param f (n, C), not read on B; empty: 0
    MatrixXd extend(const MatrixXd& last_values, const MatrixXd& f = {}) const;

    /// The wanted rows of A^-1 f, (wanted, C). Fewer wanted rows and fewer nonzero rows of f take less time.
    MatrixXd solve_for(const std::vector<Index>& wanted, const MatrixXd& f) const;

    /// The wanted rows of extend(last_values).
    MatrixXd extend_to(const std::vector<Index>& wanted, const MatrixXd& last_values) const;

    /// -A_BI A_II^-1 f_I, in the order of B: (b, C). @param f (n, C), not read on B
    MatrixXd flux_to_last(const MatrixXd& f) const;

    /// x with (A x)_I = f_I and x = 0 on B, and -(A x)_B, in the order of B. @param f (n), not read on B
    std::pair<VectorXd, VectorXd> solve_inner(const VectorXd& f) const;

    /// The blocks of A^-1 for sets of rows. A has an entry, if only an explicit 0, between any two rows of a set.
    /// Selected inversion takes about twice as long as the factorization.
    std::vector<MatrixXd> inverse_blocks(const std::vector<std::vector<Index>>& sets) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Harmonic functions with given values on a set of vertices: K_II u_I = -K_IB u_B (paper, equation 2).
class DirichletSolver {
public:
    /// @param laplacian stored with its upper and its lower triangle
    /// @param fixed (V) 1 where the value is given
    DirichletSolver(const SparseMatrix& laplacian, const std::vector<char>& fixed);

    /// @param values (V, C) one harmonic function a column; rows of free vertices are ignored
    /// @return (V, C) harmonic at the free vertices, equal to the given values at the fixed vertices
    MatrixXd solve(const MatrixXd& values) const;

private:
    std::vector<Index> free_;  // vertices that are solved for
    std::vector<Index> fixed_;
    SparseMatrix coupling_;  // K_IB
    std::unique_ptr<SparseCholesky> cholesky_;
};

}  // namespace koebe
