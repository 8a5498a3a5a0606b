// A dense block of a factorization, eliminated. For the .cpp files of this folder only.
#pragma once

#include "core/types.h"

namespace koebe::detail {

/// Factor of the first columns of a symmetric matrix, and the Schur complement on the others: by blocks, on the
/// thread's share of threads; the same ones for any number of them.
/// @param columns (height, width) in: the first columns, lower triangle; out: L, what stands above its diagonal unread
/// @param rest (height - width, height - width) the others, lower triangle; out: less their part of L L'
/// @throws SolverError if the matrix is not positive definite
void eliminate(double* columns, Index height, Index width, double* rest);

}  // namespace koebe::detail
