// Dense matrices, most of them symmetric positive definite.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// The factor L of matrix = L L', in the lower triangle; what stands above it is not zero.
/// @throws SolverError if the matrix is not positive definite
MatrixXd spd_factor(MatrixXd matrix);

/// The inverse of a lower triangular matrix, zero above the diagonal; what stands there is not read.
MatrixXd lower_inverse(MatrixXd lower);

/// Solution of matrix * x = right_hand_side. @throws SolverError if the matrix is not positive definite
MatrixXd spd_solve(MatrixXd matrix, MatrixXd right_hand_side);

/// The product A' A.
MatrixXd gram(const Eigen::Ref<const MatrixXd>& a);

/// The product L L' of a lower triangular matrix (its strict upper part is not read).
MatrixXd lower_times_transpose(const MatrixXd& lower);

/// Eigen's products in blocks of one size from now on, which it takes from the processor's caches else: sums would have
/// another order on another processor. Every call that computes begins with it.
KOEBE_API void fix_product_blocks();

}  // namespace koebe
