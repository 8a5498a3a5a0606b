// The dense kernels under their BLAS and LAPACK names. For the .cpp files of this folder only.
#pragma once

#include "kernels/dense_kernels.h"

namespace koebe::detail {

#define KOEBE_FORWARD(name, parameters, arguments)                                                                     \
    inline void name##_ parameters { kernels::chosen().name arguments; }
KOEBE_DENSE_KERNELS(KOEBE_FORWARD)
#undef KOEBE_FORWARD

/// C = beta C + alpha A B', for the lower trapezoid alone: the first n rows of A and C form a lower triangle.
/// @param a (m, k) @param b (n, k), the first rows of A @param c (m, n)
inline void lower_product(int m, int n, int k, double alpha, const double* a, int a_stride, double beta, double* c,
                          int c_stride)
{
    dsyrk_("L", "N", &n, &k, &alpha, a, &a_stride, &beta, c, &c_stride);
    const int below = m - n;
    if (below > 0) dgemm_("N", "T", &below, &n, &k, &alpha, a + n, &a_stride, a, &a_stride, &beta, c + n, &c_stride);
}

}  // namespace koebe::detail
