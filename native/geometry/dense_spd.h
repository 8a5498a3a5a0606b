// Dense symmetric positive definite matrices on LAPACK.
#pragma once

#include "core/types.h"

namespace koebe {

/// The full inverse. @throws SolverError if the matrix is not positive definite
MatrixXd spd_inverse(MatrixXd matrix);

/// Solution of matrix * x = right_hand_side. @throws SolverError if the matrix is not positive definite
MatrixXd spd_solve(MatrixXd matrix, MatrixXd right_hand_side);

/// The product L L' of a lower triangular matrix (its strict upper part is not read).
MatrixXd lower_times_transpose(const MatrixXd& lower);

/// Sets the number of threads of the dense kernels for the lifetime of the object; 0 means all cores.
class DenseThreads {
public:
    explicit DenseThreads(int threads);
    ~DenseThreads();
    DenseThreads(const DenseThreads&) = delete;
    DenseThreads& operator=(const DenseThreads&) = delete;

private:
    int before_;
};

}  // namespace koebe
