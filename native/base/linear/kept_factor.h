// A factor that is kept for the next matrix of the same pattern, and Newton's step by it.
#pragma once

#include "linear/sparse_cholesky.h"

#include <optional>
#include <utility>

namespace koebe {

using KeptFactor = std::optional<SparseCholesky>;

/// Factors a matrix. Its pattern is analyzed only if there is no factor yet.
/// @param kept empty, or of a matrix of the same pattern @return what kept holds now
/// @throws SolverError if the matrix is not positive definite
const SparseCholesky& factored(KeptFactor& kept, const SparseMatrix& matrix);

/// -H^-1 gradient. If this step does not lower the function, or H is singular: minus the gradient over the diagonal.
/// @param hessian H, the lower triangle, each column from its diagonal on. It gets 1 for what is not positive on the
/// diagonal, and more by the share `shift` for all else
/// @return the step and its slope; the slope is not below 0 if neither step lowers the function
std::pair<VectorXd, double> newton_descent(SparseMatrix& hessian, const VectorXd& gradient, double shift,
                                           KeptFactor& kept);

}  // namespace koebe
