// A dense block of a factorization, eliminated, and solved with. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

namespace koebe::detail {

/// Factor of the first columns of a symmetric matrix, and the Schur complement on the others: by blocks, on the
/// thread's share of threads; the same ones for any number of them.
/// @param columns (height, width) in: the first columns, lower triangle; out: L, what stands above its diagonal unread
/// @param rest (height - width, height - width) the others, lower triangle; out: less their part of L L'
/// @throws SolverError if the matrix is not positive definite
void eliminate(double* columns, Index height, Index width, double* rest);

/// The block's part of X = L^-1 X. @param block (height, width) of L @param first row of X
/// @param update (height - width, n) out: to be added to the rows below
void substitute_forward(const double* block, Index height, Index width, Index first, MatrixXd& x, MatrixXd& update);

/// The block's part of X = L^-T X. @param rows (height - width) below it
void substitute_backward(const double* block, Index height, Index width, Index first, const Index* rows, MatrixXd& x);

}  // namespace koebe::detail
