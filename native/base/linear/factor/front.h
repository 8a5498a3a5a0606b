// Eliminates a dense block of a factorization, and solves with it. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

namespace koebe::detail {

/// Factors the first columns of a symmetric matrix and computes the Schur complement on the others. Works by blocks on
/// the thread's share of threads; any number of threads gives the same result.
/// @param columns (height, width) in: the first columns, lower triangle; out: L, entries above its diagonal undefined
/// @param rest (height - width, height - width) in: the other columns, lower triangle; out: the Schur complement
/// @throws SolverError if the matrix is not positive definite
void eliminate(double* columns, Index height, Index width, double* rest);

/// Does the block's part of X = L^-1 X. @param block (height, width) of L @param first the block's first row in X
/// @param update (height - width, n) out: to be added to the rows below
void substitute_forward(const double* block, Index height, Index width, Index first, MatrixXd& x, MatrixXd& update);

/// Does the block's part of X = L^-T X. @param rows (height - width) row numbers below the block
void substitute_backward(const double* block, Index height, Index width, Index first, const Index* rows, MatrixXd& x);

}  // namespace koebe::detail
