// Compiled once for each instruction set; KOEBE_INSTRUCTION_SET is its name. Eigen gets a namespace by that name as
// well: else the linker would keep one of several equal-named functions, and an old processor meet the instructions of
// a new.
#define KOEBE_JOIN_(a, b) a##b
#define KOEBE_JOIN(a, b) KOEBE_JOIN_(a, b)
#define Eigen KOEBE_JOIN(Eigen_, KOEBE_INSTRUCTION_SET)
#define KOEBE_OF_SET KOEBE_JOIN(of_, KOEBE_INSTRUCTION_SET)

#include "bundle/kernels/dense_kernels.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <type_traits>

namespace koebe::kernels {
namespace KOEBE_OF_SET {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
using Stride = Eigen::OuterStride<>;
using In = Eigen::Map<const Matrix, 0, Stride>;
using Out = Eigen::Map<Matrix, 0, Stride>;
using VectorIn = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 1>, 0, Eigen::InnerStride<>>;
using VectorOut = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 1>, 0, Eigen::InnerStride<>>;

bool is(const char* option, char letter) { return *option == letter || *option == letter + ('a' - 'A'); }

bool transposed(const char* option) { return !is(option, 'N'); }

/// target *= beta, where 0 clears what may be no number.
template <class Target>
void scale(Target&& target, double beta)
{
    if (beta == 0.0)
        target.setZero();
    else if (beta != 1.0)
        target *= beta;
}

void scale_triangle(Out c, bool lower, double beta)
{
    if (beta == 1.0) return;
    const Eigen::Index n = c.cols();
    for (Eigen::Index j = 0; j < n; ++j)
        if (lower)
            scale(c.col(j).tail(n - j), beta);
        else
            scale(c.col(j).head(j + 1), beta);
}

/// Calls a function with a triangle of A, or of A', as Eigen has it.
template <class Function>
void with_triangle(const In& a, bool lower, bool transpose, bool unit, const Function& function)
{
    const auto with_diagonal = [&](const auto& matrix, auto mode) {
        if (unit)
            function(matrix.template triangularView<mode | Eigen::UnitDiag>());
        else
            function(matrix.template triangularView<mode>());
    };
    using Lower = std::integral_constant<unsigned, Eigen::Lower>;
    using Upper = std::integral_constant<unsigned, Eigen::Upper>;
    if (lower && transpose)
        with_diagonal(a.transpose(), Upper());
    else if (lower)
        with_diagonal(a, Lower());
    else if (transpose)
        with_diagonal(a.transpose(), Lower());
    else
        with_diagonal(a, Upper());
}

void dgemm(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,
           const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
           const int* ldc)
{
    if (*m == 0 || *n == 0) return;
    Out product(c, *m, *n, Stride(*ldc));
    scale(product, *beta);
    if (*k == 0 || *alpha == 0.0) return;
    const bool ta = transposed(trans_a), tb = transposed(trans_b);
    const In left(a, ta ? *k : *m, ta ? *m : *k, Stride(*lda)), right(b, tb ? *n : *k, tb ? *k : *n, Stride(*ldb));
    if (ta && tb)
        product.noalias() += *alpha * left.transpose() * right.transpose();
    else if (ta)
        product.noalias() += *alpha * left.transpose() * right;
    else if (tb)
        product.noalias() += *alpha * left * right.transpose();
    else
        product.noalias() += *alpha * left * right;
}

void dgemv(const char* trans, const int* m, const int* n, const double* alpha, const double* a, const int* lda,
           const double* x, const int* incx, const double* beta, double* y, const int* incy)
{
    const bool t = transposed(trans);
    if (*m == 0 || *n == 0) return;
    const In matrix(a, *m, *n, Stride(*lda));
    const VectorIn in(x, t ? *m : *n, Eigen::InnerStride<>(*incx));
    VectorOut out(y, t ? *n : *m, Eigen::InnerStride<>(*incy));
    scale(out, *beta);
    if (t)
        out.noalias() += *alpha * matrix.transpose() * in;
    else
        out.noalias() += *alpha * matrix * in;
}

void dsymm(const char* side, const char* uplo, const int* m, const int* n, const double* alpha, const double* a,
           const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc)
{
    if (*m == 0 || *n == 0) return;
    const bool left = is(side, 'L'), lower = is(uplo, 'L');
    const int order = left ? *m : *n;
    const In symmetric(a, order, order, Stride(*lda)), other(b, *m, *n, Stride(*ldb));
    Out product(c, *m, *n, Stride(*ldc));
    scale(product, *beta);
    if (left && lower)
        product.noalias() += *alpha * symmetric.selfadjointView<Eigen::Lower>() * other;
    else if (left)
        product.noalias() += *alpha * symmetric.selfadjointView<Eigen::Upper>() * other;
    else if (lower)
        product.noalias() += *alpha * other * symmetric.selfadjointView<Eigen::Lower>();
    else
        product.noalias() += *alpha * other * symmetric.selfadjointView<Eigen::Upper>();
}

void dsyrk(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
           const int* lda, const double* beta, double* c, const int* ldc)
{
    if (*n == 0) return;
    const bool lower = is(uplo, 'L'), t = transposed(trans);
    Out product(c, *n, *n, Stride(*ldc));
    scale_triangle(product, lower, *beta);
    if (*k == 0 || *alpha == 0.0) return;
    const In factor(a, t ? *k : *n, t ? *n : *k, Stride(*lda));
    if (lower && t)
        product.selfadjointView<Eigen::Lower>().rankUpdate(factor.transpose(), *alpha);
    else if (lower)
        product.selfadjointView<Eigen::Lower>().rankUpdate(factor, *alpha);
    else if (t)
        product.selfadjointView<Eigen::Upper>().rankUpdate(factor.transpose(), *alpha);
    else
        product.selfadjointView<Eigen::Upper>().rankUpdate(factor, *alpha);
}

void dtrmm(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
           const double* alpha, const double* a, const int* lda, double* b, const int* ldb)
{
    if (*m == 0 || *n == 0) return;
    const bool left = is(side, 'L');
    const int order = left ? *m : *n;
    const In triangle(a, order, order, Stride(*lda));
    Out matrix(b, *m, *n, Stride(*ldb));
    with_triangle(triangle, is(uplo, 'L'), transposed(trans), is(diag, 'U'), [&](const auto& view) {
        const Matrix product = left ? Matrix(view * matrix) : Matrix(matrix * view);
        matrix = *alpha * product;
    });
}

void dtrsm(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
           const double* alpha, const double* a, const int* lda, double* b, const int* ldb)
{
    if (*m == 0 || *n == 0) return;
    const bool left = is(side, 'L');
    const int order = left ? *m : *n;
    const In triangle(a, order, order, Stride(*lda));
    Out matrix(b, *m, *n, Stride(*ldb));
    scale(matrix, *alpha);
    with_triangle(triangle, is(uplo, 'L'), transposed(trans), is(diag, 'U'), [&](const auto& view) {
        if (left)
            view.template solveInPlace<Eigen::OnTheLeft>(matrix);
        else
            view.template solveInPlace<Eigen::OnTheRight>(matrix);
    });
}

void dtrsv(const char* uplo, const char* trans, const char* diag, const int* n, const double* a, const int* lda,
           double* x, const int* incx)
{
    if (*n == 0) return;
    const In triangle(a, *n, *n, Stride(*lda));
    VectorOut vector(x, *n, Eigen::InnerStride<>(*incx));
    with_triangle(triangle, is(uplo, 'L'), transposed(trans), is(diag, 'U'),
                  [&](const auto& view) { view.solveInPlace(vector); });
}

void dpotrf(const char* uplo, const int* n, double* a, const int* lda, int* info)
{
    Out matrix(a, *n, *n, Stride(*lda));
    Eigen::Index failed = -1;
    if (*n > 0 && is(uplo, 'L'))
        failed = Eigen::internal::llt_inplace<double, Eigen::Lower>::blocked(matrix);
    else if (*n > 0)
        failed = Eigen::internal::llt_inplace<double, Eigen::Upper>::blocked(matrix);
    *info = static_cast<int>(failed + 1);
}

void dtrtri(const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info)
{
    *info = 0;
    if (*n == 0) return;
    Out matrix(a, *n, *n, Stride(*lda));
    if (!is(diag, 'U'))
        for (int i = 0; i < *n; ++i)
            if (matrix(i, i) == 0.0) {
                *info = i + 1;
                return;
            }
    const Matrix original = matrix;
    Matrix inverse = Matrix::Identity(*n, *n);
    with_triangle(In(original.data(), *n, *n, Stride(*n)), is(uplo, 'L'), false, is(diag, 'U'),
                  [&](const auto& view) { view.solveInPlace(inverse); });
    if (is(uplo, 'L'))
        matrix.triangularView<Eigen::Lower>() = inverse;
    else
        matrix.triangularView<Eigen::Upper>() = inverse;
}

void dpotrs(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b, const int* ldb,
            int* info)
{
    const double one = 1.0;
    const char* const first = is(uplo, 'L') ? "N" : "T";
    const char* const second = is(uplo, 'L') ? "T" : "N";
    dtrsm("L", uplo, first, "N", n, nrhs, &one, a, lda, b, ldb);
    dtrsm("L", uplo, second, "N", n, nrhs, &one, a, lda, b, ldb);
    *info = 0;
}

/// (L L')^-1 = L^-T L^-1, (U' U)^-1 = U^-1 U^-T, in the triangle that held the factor.
void dpotri(const char* uplo, const int* n, double* a, const int* lda, int* info)
{
    dtrtri(uplo, "N", n, a, lda, info);
    if (*info != 0 || *n == 0) return;
    const bool lower = is(uplo, 'L');
    const double one = 1.0, zero = 0.0;
    Out matrix(a, *n, *n, Stride(*lda));
    Matrix inverse = Matrix::Zero(*n, *n);
    if (lower)
        inverse.triangularView<Eigen::Lower>() = matrix;
    else
        inverse.triangularView<Eigen::Upper>() = matrix;
    dsyrk(uplo, lower ? "T" : "N", n, n, &one, inverse.data(), n, &zero, a, lda);
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
    };
    return kernels;
}

}  // namespace koebe::kernels
