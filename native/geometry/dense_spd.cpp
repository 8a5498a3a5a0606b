#include "geometry/dense_spd.h"

#include "core/errors.h"

#include <algorithm>
#include <string>
#include <thread>

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrtri_(const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info);
void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b,
             const int* ldb, int* info);
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc);
void dtrmm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
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

/// By halves, [A 0; B C]^-1 = [A^-1 0; -C^-1 B A^-1, C^-1]: twice as fast as dtrtri at n = 1,400.
void invert_lower(double* lower, int n, int stride)
{
    if (n <= 64) {
        int info = 0;
        dtrtri_("L", "N", &n, lower, &stride, &info);
        if (info != 0) throw SolverError("triangular inverse failed, status " + std::to_string(info));
        return;
    }
    const int top = n / 2, bottom = n - top;
    double* b = lower + top;
    double* c = lower + top + static_cast<std::ptrdiff_t>(top) * stride;
    invert_lower(lower, top, stride);
    invert_lower(c, bottom, stride);
    const double one = 1.0, minus_one = -1.0;
    dtrmm_("R", "L", "N", "N", &bottom, &top, &one, lower, &stride, b, &stride);
    dtrmm_("L", "L", "N", "N", &bottom, &top, &minus_one, c, &stride, b, &stride);
}

}  // namespace

MatrixXd spd_factor(MatrixXd matrix)
{
    factorize(matrix);
    return matrix;
}

MatrixXd bordered_factor(const MatrixXd& factor_of_a, const Eigen::Ref<const MatrixXd>& b, MatrixXd c)
{
    const int inner = static_cast<int>(factor_of_a.rows()), border = static_cast<int>(c.rows()), n = inner + border;
    MatrixXd lower(n, n);
    lower.topLeftCorner(inner, inner) = factor_of_a;
    lower.bottomLeftCorner(border, inner) = b;
    const double one = 1.0, minus_one = -1.0;
    double* below = lower.data() + inner;
    if (inner > 0) {
        dtrsm_("R", "L", "T", "N", &border, &inner, &one, factor_of_a.data(), &inner, below, &n);
        dsyrk_("L", "N", &border, &inner, &minus_one, below, &n, &one, c.data(), &border);
    }
    factorize(c);
    lower.bottomRightCorner(border, border) = c;
    lower.triangularView<Eigen::StrictlyUpper>().setZero();
    return lower;
}

MatrixXd lower_inverse(MatrixXd lower)
{
    invert_lower(lower.data(), static_cast<int>(lower.rows()), static_cast<int>(lower.rows()));
    return lower;
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

MatrixXd gram(const Eigen::Ref<const MatrixXd>& a)
{
    MatrixXd product(a.cols(), a.cols());
    const int n = static_cast<int>(a.cols()), inner = static_cast<int>(a.rows());
    const int stride = static_cast<int>(a.outerStride());
    const double one = 1.0, zero = 0.0;
    dsyrk_("L", "T", &n, &inner, &one, a.data(), &stride, &zero, product.data(), &n);
    product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
    return product;
}

MatrixXd transpose_times(const Eigen::Ref<const MatrixXd>& a, const Eigen::Ref<const MatrixXd>& b)
{
    MatrixXd product(a.cols(), b.cols());
    const int rows = static_cast<int>(a.cols()), columns = static_cast<int>(b.cols());
    const int inner = static_cast<int>(a.rows()), stride_a = static_cast<int>(a.outerStride());
    const int stride_b = static_cast<int>(b.outerStride());
    const double one = 1.0, zero = 0.0;
    dgemm_("T", "N", &rows, &columns, &inner, &one, a.data(), &stride_a, b.data(), &stride_b, &zero, product.data(),
           &rows);
    return product;
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
    : before_(count())
{
    if (threads <= 0) {
        const bool large = boundary_count >= 1500 || face_count >= 200000;
        threads = large ? static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) : 1;
    }
    openblas_set_num_threads(threads);
}

DenseThreads::DenseThreads(int threads) : before_(count()) { openblas_set_num_threads(threads); }

int DenseThreads::count() { return openblas_get_num_threads(); }

DenseThreads::~DenseThreads() { openblas_set_num_threads(before_); }

}  // namespace koebe
