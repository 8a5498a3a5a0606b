// The dense kernels of BLAS and LAPACK that linear/ calls. They give the same bits on every processor, so that a map
// depends on its surface only. They follow Fortran's calling convention (netlib.org/blas, LAPACK Users' Guide, section
// 2): all arguments by address, matrices by columns. One more kernel counts bits, for packing.
#pragma once

#include <cstdint>

/// X(name, parameters): `name` as in BLAS and LAPACK, without the underscore.
#define KOEBE_DENSE_KERNELS(X)                                                                                         \
    X(dgemm,                                                                                                           \
      (const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,        \
       const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,                \
       const int* ldc),                                                                                                \
      (trans_a, trans_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc))                                                \
    X(dgemv,                                                                                                           \
      (const char* trans, const int* m, const int* n, const double* alpha, const double* a, const int* lda,            \
       const double* x, const int* incx, const double* beta, double* y, const int* incy),                              \
      (trans, m, n, alpha, a, lda, x, incx, beta, y, incy))                                                            \
    X(dsymm,                                                                                                           \
      (const char* side, const char* uplo, const int* m, const int* n, const double* alpha, const double* a,           \
       const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc),                \
      (side, uplo, m, n, alpha, a, lda, b, ldb, beta, c, ldc))                                                         \
    X(dsyrk,                                                                                                           \
      (const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,          \
       const int* lda, const double* beta, double* c, const int* ldc),                                                 \
      (uplo, trans, n, k, alpha, a, lda, beta, c, ldc))                                                                \
    X(dtrmm,                                                                                                           \
      (const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,            \
       const double* alpha, const double* a, const int* lda, double* b, const int* ldb),                               \
      (side, uplo, trans, diag, m, n, alpha, a, lda, b, ldb))                                                          \
    X(dtrsm,                                                                                                           \
      (const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,            \
       const double* alpha, const double* a, const int* lda, double* b, const int* ldb),                               \
      (side, uplo, trans, diag, m, n, alpha, a, lda, b, ldb))                                                          \
    X(dtrsv,                                                                                                           \
      (const char* uplo, const char* trans, const char* diag, const int* n, const double* a, const int* lda,           \
       double* x, const int* incx),                                                                                    \
      (uplo, trans, diag, n, a, lda, x, incx))                                                                         \
    X(dpotrf, (const char* uplo, const int* n, double* a, const int* lda, int* info), (uplo, n, a, lda, info))         \
    X(dpotri, (const char* uplo, const int* n, double* a, const int* lda, int* info), (uplo, n, a, lda, info))         \
    X(dpotrs,                                                                                                          \
      (const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b, const int* ldb,    \
       int* info),                                                                                                     \
      (uplo, n, nrhs, a, lda, b, ldb, info))                                                                           \
    X(dtrtri, (const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info),                \
      (uplo, diag, n, a, lda, info))

namespace koebe::kernels {

struct DenseKernels {
// NOLINTNEXTLINE(bugprone-macro-parentheses): a declaration allows none
#define KOEBE_MEMBER(name, parameters, arguments) void(*name) parameters;
    KOEBE_DENSE_KERNELS(KOEBE_MEMBER)
#undef KOEBE_MEMBER
    /// The number of bits set both in `own` and in the columns `left` and `right` side by side, moved by `shift` bits.
    /// @param shift 0 to 63 @param rows words of each column
    std::int64_t (*common_bits)(const std::uint64_t* own, const std::uint64_t* left, const std::uint64_t* right,
                                int shift, int rows);
};

/// The same source compiled for several processors. This one runs on every processor of the target.
const DenseKernels& baseline();
const DenseKernels& avx2();    // with FMA
const DenseKernels& avx512();  // F, DQ, BW, VL

/// The best set for the processor, or a smaller one that KOEBE_KERNELS names in the environment: sse2, avx2, avx512.
const DenseKernels& chosen();

}  // namespace koebe::kernels
