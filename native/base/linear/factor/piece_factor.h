// Factors one piece of a matrix. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/analysis.h"
#include "linear/factor/matrix_places.h"
#include "linear/factor/rest_pool.h"

namespace koebe::detail {

/// Computes the values of a piece's supernodes, each from the supernodes to its left (Ng and Peyton 1993).
/// @param tops first row of L that belongs to no piece
/// @param values of the whole factor
/// @param rest of the size of the interface: the update of the piece is subtracted from it
/// @param places of the matrix, if known; then the piece is the whole matrix
/// @throws SolverError if the matrix is not positive definite
void factorize_piece(const SparseMatrix& matrix, const DiagonalShift& shift, const Supernodes& l,
                     const FactorPart& part, Index tops, double* values, const LowerMatrix& rest,
                     const MatrixPlaces* places = nullptr);

}  // namespace koebe::detail
