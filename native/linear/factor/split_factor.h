// A factor made of pieces that are eliminated side by side. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"
#include "linear/factor/piece_factor.h"
#include "linear/factor/split_layout.h"
#include "linear/large_array.h"

#include <memory>
#include <vector>

namespace koebe::detail {

/// Factor A = L L' by nested dissection: first the pieces, on the thread's share of threads, then the separators, each
/// a dense block, from the small ones on. It is the same for any number of threads. Places are of 64 bits: there can be
/// more than 2^31 numbers.
class SplitFactor {
public:
    /// Symbolic analysis. @return null where the graph does not come apart
    /// @param matrix both triangles @param last rows that are kept to the end @param piece_rows of a piece at most,
    /// about
    static std::unique_ptr<SplitFactor> analyze(const SparseMatrix& matrix, const std::vector<Index>& last,
                                                Index piece_rows);

    /// Of a matrix of the same pattern. @throws SolverError if it is not positive definite
    void factorize(const SparseMatrix& matrix);

    const SupernodeLayout& layout() const { return layout_; }
    const double* values() const { return values_.data(); }
    /// Bytes that factorize() takes.
    double memory() const;

    /// X = L^-1 X and X = L^-T X, rows in the factor's order.
    void solve_lower(MatrixXd& x) const;
    void solve_upper(MatrixXd& x) const;

private:
    void analyze_pieces(const SparseMatrix& matrix, const std::vector<const std::vector<Index>*>& rows);
    void analyze_separator(const SparseMatrix& matrix, SplitPart& part);
    void lay_out(const std::vector<PieceSupernodes>& pieces);
    void factorize_separator(const SparseMatrix& matrix, const SplitPart& part, std::vector<LowerMatrix>& rests,
                             RestPool& pool);
    void solve_lower(const SplitPart& part, MatrixXd& x, MatrixXd& interface) const;
    void solve_upper(const SplitPart& part, MatrixXd& x) const;

    SupernodeLayout layout_;
    std::vector<SplitPart>
        parts_;  // the pieces, then the separators, each after those that it parts, then what is last
    std::size_t piece_count_ = 0;
    std::vector<std::vector<std::size_t>> rounds_;  // separators: those of a round touch none of the others
    Index tops_ = 0;                                // first row that belongs to no piece
    LargeArray values_;
};

}  // namespace koebe::detail
