#include "geometry/dense_spd.h"

#include "core/errors.h"

#include <algorithm>
#include <string>
#include <thread>

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b,
             const int* ldb, int* info);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
            const int* lda, const double* beta, double* c, const int* ldc);
void openblas_set_num_threads(int threads);
int openblas_get_num_threads();
}

namespace koebe {
namespace {

void factorize(MatrixXd& matrix)
{
    const int n = static_cast<int>(matrix.rows());
    int info = 0;
    dpotrf_("L", &n, matrix.data(), &n, &info);
    if (info != 0)
        throw SolverError("dense Cholesky: leading minor " + std::to_string(info) + " of " + std::to_string(n) +
                          " is not positive");
}

}  // namespace

MatrixXd spd_inverse(MatrixXd matrix)
{
    factorize(matrix);
    const int n = static_cast<int>(matrix.rows());
    int info = 0;
    dpotri_("L", &n, matrix.data(), &n, &info);
    if (info != 0) throw SolverError("dense inverse failed, status " + std::to_string(info));
    matrix.triangularView<Eigen::StrictlyUpper>() = matrix.transpose();
    return matrix;
}

MatrixXd spd_solve(MatrixXd matrix, MatrixXd right_hand_side)
{
    factorize(matrix);
    const int n = static_cast<int>(matrix.rows()), columns = static_cast<int>(right_hand_side.cols());
    int info = 0;
    dpotrs_("L", &n, &columns, matrix.data(), &n, right_hand_side.data(), &n, &info);
    if (info != 0) throw SolverError("dense solve failed, status " + std::to_string(info));
    return right_hand_side;
}

MatrixXd lower_times_transpose(const MatrixXd& lower)
{
    const int m = static_cast<int>(lower.rows());
    MatrixXd product = MatrixXd::Zero(m, m);
    // A block of columns of L touches only the rows from its own down, so the zeros above cost nothing.
    const int block = 256;
    const double one = 1.0;
    for (int k = 0; k < m; k += block) {
        const int height = m - k, width = std::min(block, m - k);
        MatrixXd panel = lower.block(k, k, height, width);
        panel.topRows(width).triangularView<Eigen::StrictlyUpper>().setZero();
        dsyrk_("L", "N", &height, &width, &one, panel.data(), &height, &one, &product(k, k), &m);
    }
    product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
    return product;
}

DenseThreads::DenseThreads(int threads, Index boundary_count, Index face_count)
    : before_(openblas_get_num_threads())
{
    if (threads <= 0) {
        const bool large = boundary_count >= 1500 || face_count >= 200000;
        threads = large ? static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) : 1;
    }
    openblas_set_num_threads(threads);
}

DenseThreads::~DenseThreads() { openblas_set_num_threads(before_); }

}  // namespace koebe
