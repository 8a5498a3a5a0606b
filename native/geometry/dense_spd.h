// Dense matrices on LAPACK and BLAS, most of them symmetric positive definite.
#pragma once

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

/// Sets the number of threads of the dense kernels for the lifetime of the object.
///
/// 0 leaves the choice to the size of the work: one thread below 1,500 boundary vertices and 200,000 faces, else all
/// cores. On small matrices the kernels' threads wait for each other actively: idle cores gain little, busy ones
/// (Blender redraws, another job runs) made choi_alex3 eight times slower.
class DenseThreads {
public:
    DenseThreads(int threads, Index boundary_count, Index face_count);
    ~DenseThreads();
    DenseThreads(const DenseThreads&) = delete;
    DenseThreads& operator=(const DenseThreads&) = delete;

private:
    int before_;
};

}  // namespace koebe
