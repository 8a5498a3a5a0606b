// Forward substitution along the elimination tree. For the .cpp files of this folder only.
#pragma once

#include "linear/supernodal_factor.h"

namespace koebe::detail {

/// Y = L^-1 B for a sparse B: it vanishes but on the supernodes on the way from B's rows to the root of the elimination
/// tree.
struct PathSolution {
    std::vector<Index> path;   // supernodes, ascending
    std::vector<Index> place;  // of each supernode among the columns of y, -1 where it is not on the path
    MatrixXd y;                // Y on the path, transposed

    /// The column of y that belongs to a row of L.
    Index column(const SupernodalFactor& l, Index row) const
    {
        return place[l.supernode[row]] + row - l.first_column(l.supernode[row]);
    }
};
PathSolution path_solution(const SupernodalFactor& l, const SparseMatrix& b);

/// X = L^-T Y = A^-1 B on the path, transposed as y is.
MatrixXd back_substitution(const SupernodalFactor& l, const PathSolution& solution);

}  // namespace koebe::detail
