// The supernodes of a factor A = L L'. For the .cpp files of linear/ only.
#pragma once

#include "linear/cholmod_support.h"
#include "linear/factor/split_factor.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace koebe::detail {

/// A supernode s is a run of columns with the same rows below them, kept as one dense block (height, width); the first
/// width rows are the columns' own.
struct SupernodalFactor {
    CholmodCommon common;
    Factor factor;                       // of CHOLMOD, or
    std::unique_ptr<SplitFactor> split;  // of pieces
    std::vector<Index> rank;             // of each row of A in the factor's order
    std::vector<Index> supernode;        // of each row of L

    /// Fills rank and supernode once the factor has been analyzed.
    void number();
    /// Room for the numbers of a factor that CHOLMOD has analyzed.
    void make_room();

    Index size() const { return size_; }
    Index supernode_count() const { return supernode_count_; }
    const Index* order() const { return order_; }
    Index first_column(Index s) const { return first_[s]; }
    Index width(Index s) const { return first_column(s + 1) - first_column(s); }
    const Index* rows(Index s) const { return rows_ + (split ? split_row_begin_[s] : row_begin_[s]); }
    Index height(Index s) const { return static_cast<Index>(rows(s + 1) - rows(s)); }
    /// The next supernode on the way to the root of the elimination tree; the root's is itself.
    Index parent(Index s) const { return height(s) == width(s) ? s : supernode[rows(s)[width(s)]]; }
    const double* values(Index s) const
    {
        if (split) return split->values() + split->layout().value_begin[s];
        return static_cast<const double*>(factor->x) + static_cast<const Index*>(factor->px)[s];
    }

    /// The last rows and columns of L as a dense lower triangle.
    MatrixXd trailing_block(Index count) const;
    /// Solves with L, L' or A. @param system CHOLMOD_L, CHOLMOD_Lt (both in the factor's order) or CHOLMOD_A
    MatrixXd solve(int system, const MatrixXd& right_hand_side);

private:
    void solve_lower(MatrixXd& x) const;
    void solve_upper(MatrixXd& x) const;

    Index size_ = 0, supernode_count_ = 0;
    const Index *order_ = nullptr, *first_ = nullptr, *rows_ = nullptr, *row_begin_ = nullptr;
    const std::ptrdiff_t* split_row_begin_ = nullptr;
};

}  // namespace koebe::detail
