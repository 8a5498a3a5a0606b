// The factor A = L L' of a sparse matrix. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/analysis.h"
#include "linear/factor/matrix_places.h"
#include "linear/factor/rest_pool.h"
#include "linear/large_array.h"

#include <vector>

namespace koebe::detail {

/// Factors the pieces on the thread's share of threads. Then it factors the separators, each a dense block, the small
/// blocks first. Any number of threads gives the same factor.
class SupernodalFactor : public Supernodes {
public:
    /// Allocates the values.
    explicit SupernodalFactor(Analysis analysis);

    /// @param matrix has the analyzed pattern; with more than one piece: both triangles
    /// @param shift is added to it
    /// @throws SolverError if the sum is not positive definite; then there is no factor
    void factorize(const SparseMatrix& matrix, const DiagonalShift& shift);

    bool is_in_pieces() const { return parts_.size() > 1; }
    double* values(Index s) { return numbers_.data() + value_begin[s]; }
    const double* values(Index s) const { return numbers_.data() + value_begin[s]; }

    /// The last rows and columns of L as a dense lower triangle.
    MatrixXd trailing_block(Index last) const;
    /// A^-1 F, rows in A's order.
    MatrixXd solve(const MatrixXd& right_hand_side) const;
    /// X = L^-1 X and X = L^-T X, rows in the factor's order.
    void solve_lower(MatrixXd& x) const;
    void solve_upper(MatrixXd& x) const;

private:
    void factorize_separator(const SparseMatrix& matrix, const DiagonalShift& shift, const FactorPart& part,
                             std::vector<LowerMatrix>& rests, RestPool& pool);
    void solve_lower(const FactorPart& part, MatrixXd& x, MatrixXd& interface) const;
    void solve_upper(const FactorPart& part, MatrixXd& x) const;

    std::vector<FactorPart> parts_;
    std::size_t piece_count_;
    std::vector<std::vector<std::size_t>> rounds_;
    Index tops_;
    LargeArray numbers_;
    LastPattern pattern_;  // of a matrix in one piece
};

}  // namespace koebe::detail
