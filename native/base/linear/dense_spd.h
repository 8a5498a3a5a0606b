// Dense matrices, most of them symmetric positive definite.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// The factor L of matrix = L L', in the lower triangle. Entries above the diagonal are not zero.
/// @throws SolverError if the matrix is not positive definite
MatrixXd spd_factor(MatrixXd matrix);

/// The inverse of a lower triangular matrix, zero above the diagonal. Entries above the diagonal are not read.
MatrixXd lower_inverse(MatrixXd lower);

/// Solution of matrix * x = right_hand_side. @throws SolverError if the matrix is not positive definite
MatrixXd spd_solve(MatrixXd matrix, MatrixXd right_hand_side);

/// The product A' A.
MatrixXd gram(const Eigen::Ref<const MatrixXd>& a);

/// The product L L' of a lower triangular matrix. Entries above the diagonal are not read.
MatrixXd lower_times_transpose(const MatrixXd& lower);

/// Makes Eigen's products use blocks of one size. Otherwise Eigen takes the size from the processor's caches, and the
/// order of sums would differ from processor to processor. Every call that computes starts with this function.
KOEBE_API void fix_product_blocks();

}  // namespace koebe
