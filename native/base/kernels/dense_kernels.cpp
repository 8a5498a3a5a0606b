// Compiled once for each instruction set; KOEBE_INSTRUCTION_SET is its name. All sets give the same bits: vectors hold
// independent results, each sum has one order, and products are rounded before they are added (-ffp-contract=off).
// Functions that are inlined elsewhere too are not used here: the linker keeps one of several equal-named functions,
// and an old processor might meet the instructions of a new one.
#define KOEBE_JOIN_(a, b) a##b
#define KOEBE_JOIN(a, b) KOEBE_JOIN_(a, b)
#define KOEBE_OF_SET KOEBE_JOIN(of_, KOEBE_INSTRUCTION_SET)

#include "kernels/dense_kernels.h"

#include "kernels/common_bits.h"
#include "kernels/dense_product.h"
#include "kernels/dense_triangle.h"

namespace koebe::kernels {
namespace KOEBE_OF_SET {
namespace {

bool is(const char* option, char letter) { return *option == letter || *option == letter + ('a' - 'A'); }

View given(const double* a, const int* lda, const char* trans)
{
    const View view{a, 1, *lda};
    return is(trans, 'N') ? view : view.turned();
}

/// c *= beta; beta 0 also clears NaN and infinity. @param part lower: on and below the diagonal only
void scale(int m, int n, double beta, Target c, Share part = Share::all)
{
    if (beta == 1.0) return;
    for (int j = 0; j < n; ++j)
        for (int i = part == Share::lower ? j : 0; i < m; ++i) c(i, j) = beta == 0.0 ? 0.0 : beta * c(i, j);
}

void dgemm(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,
           const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
           const int* ldc)
{
    const Target product{c, 1, *ldc};
    scale(*m, *n, *beta, product);
    if (*alpha != 0.0) add_product(*m, *n, *k, *alpha, given(a, lda, trans_a), given(b, ldb, trans_b), product);
}

void dgemv(const char* trans, const int* m, const int* n, const double* alpha, const double* a, const int* lda,
           const double* x, const int* incx, const double* beta, double* y, const int* incy)
{
    const bool plain = is(trans, 'N');
    const int rows = plain ? *m : *n, columns = plain ? *n : *m;
    const Target product{y, *incy, 1};
    scale(rows, 1, *beta, product);
    add_product(rows, 1, columns, *alpha, given(a, lda, trans), View{x, *incx, 1}, product);
}

void dsymm(const char* side, const char* uplo, const int* m, const int* n, const double* alpha, const double* a,
           const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc)
{
    const bool left = is(side, 'L');
    const int order = left ? *m : *n;
    if (*m == 0 || *n == 0) return;
    const View triangle_of_a = given(a, lda, is(uplo, 'L') ? "N" : "T");
    const Buffer whole(Place{order} * order);
    for (int j = 0; j < order; ++j)
        for (int i = j; i < order; ++i)
            whole.data()[i + Place{j} * order] = whole.data()[j + Place{i} * order] = triangle_of_a(i, j);
    if (left)
        dgemm("N", "N", m, n, m, alpha, whole.data(), m, b, ldb, beta, c, ldc);
    else
        dgemm("N", "N", m, n, n, alpha, b, ldb, whole.data(), n, beta, c, ldc);
}

void dsyrk(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
           const int* lda, const double* beta, double* c, const int* ldc)
{
    const View factor = given(a, lda, trans);
    Target product{c, 1, *ldc};
    if (!is(uplo, 'L')) product = product.turned();
    scale(*n, *n, *beta, product, Share::lower);
    if (*alpha != 0.0) add_product(*n, *n, *k, *alpha, factor, factor.turned(), product, Share::lower);
}

/// A triangle and a matrix as "triangle times matrix"; "matrix times triangle" is turned for that.
struct Sides {
    View triangle;
    bool lower, unit;
    Target matrix;
    int order, count;
};

Sides sides_of(const char* side, const char* uplo, const char* trans, const char* diag, int m, int n, const double* a,
               const int* lda, double* b, const int* ldb)
{
    Sides result{given(a, lda, trans), is(uplo, 'L') == is(trans, 'N'), is(diag, 'U'), {b, 1, *ldb}, m, n};
    if (is(side, 'L')) return result;
    return {result.triangle.turned(), !result.lower, result.unit, result.matrix.turned(), n, m};
}

void dtrmm(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
           const double* alpha, const double* a, const int* lda, double* b, const int* ldb)
{
    const Sides s = sides_of(side, uplo, trans, diag, *m, *n, a, lda, b, ldb);
    multiply_triangle(s.order, s.count, *alpha, s.triangle, s.lower, s.unit, s.matrix);
}

void dtrsm(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
           const double* alpha, const double* a, const int* lda, double* b, const int* ldb)
{
    const Sides s = sides_of(side, uplo, trans, diag, *m, *n, a, lda, b, ldb);
    scale(*m, *n, *alpha, {b, 1, *ldb});
    solve_triangle(s.order, s.count, s.triangle, s.lower, s.unit, s.matrix);
}

void dtrsv(const char* uplo, const char* trans, const char* diag, const int* n, const double* a, const int* lda,
           double* x, const int* incx)
{
    solve_triangle(*n, 1, given(a, lda, trans), is(uplo, 'L') == is(trans, 'N'), is(diag, 'U'), {x, *incx, 1});
}

void dpotrf(const char* uplo, const int* n, double* a, const int* lda, int* info)
{
    const Target matrix{a, 1, *lda};
    *info = factorize(*n, is(uplo, 'L') ? matrix : matrix.turned());
}

void dtrtri(const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info)
{
    *info = 0;
    const Target matrix = is(uplo, 'L') ? Target{a, 1, *lda} : Target{a, *lda, 1};
    if (!is(diag, 'U'))
        for (int i = 0; i < *n; ++i)
            if (matrix(i, i) == 0.0) {
                *info = i + 1;
                return;
            }
    const Buffer buffer(Place{*n} * *n);
    const Target inverse{buffer.data(), 1, *n};
    for (int j = 0; j < *n; ++j)
        for (int i = 0; i < *n; ++i) inverse(i, j) = i == j ? 1.0 : 0.0;
    solve_triangle(*n, *n, matrix, true, is(diag, 'U'), inverse);
    for (int j = 0; j < *n; ++j)
        for (int i = j; i < *n; ++i) matrix(i, j) = inverse(i, j);
}

void dpotrs(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b, const int* ldb,
            int* info)
{
    const View factor = given(a, lda, is(uplo, 'L') ? "N" : "T");
    solve_triangle(*n, *nrhs, factor, true, false, {b, 1, *ldb});
    solve_triangle(*n, *nrhs, factor.turned(), false, false, {b, 1, *ldb});
    *info = 0;
}

/// (L L')^-1 = L^-T L^-1, (U' U)^-1 = U^-1 U^-T, in the triangle that held the factor.
void dpotri(const char* uplo, const int* n, double* a, const int* lda, int* info)
{
    dtrtri(uplo, "N", n, a, lda, info);
    if (*info != 0) return;
    const bool lower = is(uplo, 'L');
    const Target matrix = lower ? Target{a, 1, *lda} : Target{a, *lda, 1};
    const Buffer buffer(Place{*n} * *n);
    for (int j = 0; j < *n; ++j)
        for (int i = 0; i < *n; ++i) buffer.data()[i + Place{j} * *n] = i < j ? 0.0 : matrix(i, j);
    const double one = 1.0, zero = 0.0;
    dsyrk(uplo, "T", n, n, &one, buffer.data(), n, &zero, a, lda);
}

}  // namespace
}  // namespace KOEBE_OF_SET

const DenseKernels& KOEBE_INSTRUCTION_SET()
{
    using namespace KOEBE_OF_SET;
    static constexpr DenseKernels kernels = {
#define KOEBE_ENTRY(name, parameters, arguments) name,
        KOEBE_DENSE_KERNELS(KOEBE_ENTRY)
#undef KOEBE_ENTRY
            common_bits};
    return kernels;
}

}  // namespace koebe::kernels
