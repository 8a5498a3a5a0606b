// One piece of a dissected matrix: its elimination order, its supernodes, their numbers. For the .cpp files of this
// folder only.
#pragma once

#include "linear/factor/rest_pool.h"
#include "linear/factor/split_layout.h"

#include <vector>

namespace koebe::detail {

/// The supernodes of a piece of P rows. Row numbers below P are its own in the order of elimination, P + i is number i
/// of its interface.
struct PieceSupernodes {
    std::vector<Index> order;  ///< rows of the matrix in the order of elimination
    std::vector<Index> first;  ///< column of each supernode, and the end
    std::vector<Index> row_begin, rows;
};

/// @param matrix both triangles
/// @param rows of the piece, ascending
/// @param interface in the factor's order, ascending
/// @param rank of the rows outside pieces in the factor's order, -1 in pieces
/// @param number of each row of a piece among its piece's
PieceSupernodes analyze_piece(const SparseMatrix& matrix, const std::vector<Index>& rows,
                              const std::vector<Index>& interface, const std::vector<Index>& rank,
                              const std::vector<Index>& number);

/// Where the entries of a matrix stand in the blocks of its supernodes: for a matrix that changes, not its pattern.
struct MatrixPlaces {
    std::vector<Index> begin;  ///< of each supernode's entries, and the end
    std::vector<Index> entry;  ///< number among the matrix' own
    std::vector<Index> place;  ///< in the block
};

/// The numbers of a piece's supernodes, each from those to its left (Ng and Peyton 1993).
/// @param tops first row of L that belongs to no piece
/// @param values of the whole factor
/// @param rest of the size of the interface: what the piece's columns take from its rows is taken off
/// @param places of the matrix, if known; the piece is the whole then
/// @throws SolverError if the matrix is not positive definite
void factorize_piece(const SparseMatrix& matrix, const SupernodeLayout& layout, const SplitPart& part, Index tops,
                     double* values, const LowerMatrix& rest, const MatrixPlaces* places = nullptr);

}  // namespace koebe::detail
