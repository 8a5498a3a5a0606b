// The numbers of one piece of a matrix. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/analysis.h"
#include "linear/factor/matrix_places.h"
#include "linear/factor/rest_pool.h"

namespace koebe::detail {

/// The numbers of a piece's supernodes, each from those to its left (Ng and Peyton 1993).
/// @param tops first row of L that belongs to no piece
/// @param values of the whole factor
/// @param rest of the size of the interface: what the piece's columns take from its rows is taken off
/// @param places of the matrix, if known; the piece is the whole then
/// @throws SolverError if the matrix is not positive definite
void factorize_piece(const SparseMatrix& matrix, const Supernodes& l, const FactorPart& part, Index tops,
                     double* values, const LowerMatrix& rest, const MatrixPlaces* places = nullptr);

}  // namespace koebe::detail
