// One piece of a dissected matrix: its elimination order and its supernodes. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe::detail {

/// The supernodes of a piece of P rows. Row numbers below P are the piece's own in the order of elimination; P + i is
/// row i of its interface.
struct PieceSupernodes {
    std::vector<Index> order;  ///< rows of the matrix in the order of elimination
    std::vector<Index> first;  ///< first column of each supernode, and the end
    std::vector<Index> row_begin, rows;
};

/// @param matrix both triangles
/// @param rows of the piece, ascending
/// @param interface in the factor's order, ascending
/// @param rank of rows outside pieces in the factor's order; -1 for rows of pieces
/// @param number of each row within its piece
PieceSupernodes analyze_piece(const SparseMatrix& matrix, const std::vector<Index>& rows,
                              const std::vector<Index>& interface, const std::vector<Index>& rank,
                              const std::vector<Index>& number);

}  // namespace koebe::detail
