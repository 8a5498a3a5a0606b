// Dense matrices on LAPACK and BLAS, most of them symmetric positive definite.
#pragma once

#include "core/api.h"
#include "core/process_setting.h"
#include "core/types.h"
#include "linear/kernel_buffer.h"

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

/// OpenBLAS on one thread; and Eigen's products in blocks of one size, which it takes from the processor's caches else:
/// sums would have another order on another processor.
class KOEBE_API OneDenseThread {
public:
    OneDenseThread();
    ~OneDenseThread();
    OneDenseThread(const OneDenseThread&) = delete;
    OneDenseThread& operator=(const OneDenseThread&) = delete;

private:
    int before_;
};

/// For its lifetime the dense kernels run on one thread each, in the whole process; the last one to go restores what
/// was before. With two threads OpenBLAS adds in another order, and the last digits of a map would depend on the
/// machine. Its threads wait for each other actively, too: what idle cores gain, busy ones lose many times over
/// (Blender redraws, another job runs).
/// @throws std::bad_alloc
class SerialDenseKernels {
    KernelBuffer buffer_;
    ProcessSetting<OneDenseThread> one_thread_;
};

}  // namespace koebe
