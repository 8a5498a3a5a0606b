// The dense kernels by name. For the .cpp files of this folder only.
#pragma once

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
            const int* lda, const double* beta, double* c, const int* ldc);
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc);
}

namespace koebe::detail {

/// C = beta C + alpha A B', the lower trapezoid alone: the first n rows of A and C are a lower triangle.
/// @param a (m, k) @param b (n, k), the first rows of A @param c (m, n)
inline void lower_product(int m, int n, int k, double alpha, const double* a, int a_stride, double beta, double* c,
                          int c_stride)
{
    dsyrk_("L", "N", &n, &k, &alpha, a, &a_stride, &beta, c, &c_stride);
    const int below = m - n;
    if (below > 0) dgemm_("N", "T", &below, &n, &k, &alpha, a + n, &a_stride, a, &a_stride, &beta, c + n, &c_stride);
}

}  // namespace koebe::detail
