// The dense kernels of releases against their definitions, in every form, in every set of instructions that runs here.
#include "kernels/dense_kernels.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using Eigen::MatrixXd;
using koebe::kernels::DenseKernels;

constexpr double rounding = 1e-12;  // relative to matrices of order 1 and a hundred rows

struct Set {
    const char* name;
    const DenseKernels& (*kernels)();
};

std::vector<Set> sets()
{
    std::vector<Set> result = {{"baseline", koebe::kernels::baseline}};
#if defined(KOEBE_SEVERAL_INSTRUCTION_SETS)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        result.push_back({"avx2", koebe::kernels::avx2});
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl"))
        result.push_back({"avx512", koebe::kernels::avx512});
#endif
    return result;
}

class DenseKernelsTest : public testing::TestWithParam<Set> {
protected:
    const DenseKernels& kernels_ = GetParam().kernels();
    std::mt19937 random_{1};

    MatrixXd matrix(int rows, int columns)
    {
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random_); });
    }
    MatrixXd definite(int n)
    {
        const MatrixXd a = matrix(n, n);
        return a * a.transpose() / n + MatrixXd::Identity(n, n);
    }
    /// A triangle far from singular; the rest of the matrix is no number, as nothing may read it.
    MatrixXd triangle(int n, bool lower, bool unit)
    {
        MatrixXd a = matrix(n, n) / n;
        for (int i = 0; i < n; ++i) {
            a(i, i) = unit ? NAN : 1.5 + a(i, i);
            for (int j = 0; j < n; ++j)
                if (lower ? j > i : j < i) a(i, j) = NAN;
        }
        return a;
    }
    static MatrixXd whole(const MatrixXd& a, bool lower, bool unit)
    {
        MatrixXd result = MatrixXd::Zero(a.rows(), a.cols());
        for (int i = 0; i < a.rows(); ++i)
            for (int j = 0; j < a.cols(); ++j)
                if (i == j)
                    result(i, j) = unit ? 1.0 : a(i, j);
                else if (lower ? j < i : j > i)
                    result(i, j) = a(i, j);
        return result;
    }
};

const std::vector<int> sizes = {1, 2, 7, 16, 33, 100};

TEST_P(DenseKernelsTest, DgemmIsTheProduct)
{
    for (const int m : sizes)
        for (const int k : {1, 5, 64})
            for (const char* ta : {"N", "T"})
                for (const char* tb : {"N", "T"}) {
                    const int n = 9;
                    const bool a_turned = *ta == 'T', b_turned = *tb == 'T';
                    const MatrixXd a = a_turned ? matrix(k, m) : matrix(m, k),
                                   b = b_turned ? matrix(n, k) : matrix(k, n);
                    const int lda = static_cast<int>(a.rows()), ldb = static_cast<int>(b.rows());
                    const MatrixXd product =
                        (a_turned ? MatrixXd(a.transpose()) : a) * (b_turned ? MatrixXd(b.transpose()) : b);
                    for (const double beta : {0.0, 1.0, -0.5}) {
                        const double alpha = -1.5;
                        const MatrixXd before = matrix(m, n);
                        MatrixXd c = beta == 0.0 ? MatrixXd::Constant(m, n, NAN) : before;
                        kernels_.dgemm(ta, tb, &m, &n, &k, &alpha, a.data(), &lda, b.data(), &ldb, &beta, c.data(), &m);
                        EXPECT_LT((c - alpha * product - beta * before).cwiseAbs().maxCoeff(), rounding);
                    }
                }
}

TEST_P(DenseKernelsTest, DgemvIsTheProductWithStrides)
{
    const int m = 23, n = 11, two = 2, three = 3;
    const MatrixXd a = matrix(m, n);
    for (const char* trans : {"N", "T"}) {
        const bool turned = *trans == 'T';
        const MatrixXd x = matrix(2, turned ? m : n), before = matrix(3, turned ? n : m);
        MatrixXd y = before;
        const double alpha = 0.7, beta = -2.0;
        kernels_.dgemv(trans, &m, &n, &alpha, a.data(), &m, x.data(), &two, &beta, y.data(), &three);
        const Eigen::VectorXd product =
            turned ? Eigen::VectorXd(a.transpose() * x.row(0).transpose()) : Eigen::VectorXd(a * x.row(0).transpose());
        EXPECT_LT((y.row(0).transpose() - alpha * product - beta * before.row(0).transpose()).norm(), rounding);
        EXPECT_EQ(y.bottomRows(2), before.bottomRows(2));
    }
}

TEST_P(DenseKernelsTest, DsymmAndDsyrkTouchOneTriangle)
{
    for (const int n : sizes)
        for (const bool lower : {true, false}) {
            const char* uplo = lower ? "L" : "U";
            const MatrixXd half = triangle(n, lower, false), b = matrix(n, 6);
            const MatrixXd symmetric = whole(half, lower, false) + MatrixXd(whole(half, lower, false).transpose()) -
                                       MatrixXd(whole(half, lower, false).diagonal().asDiagonal());
            const int six = 6;
            const double alpha = -1.0, beta = 0.0;
            MatrixXd left = MatrixXd::Constant(n, 6, NAN), right = MatrixXd::Constant(6, n, NAN);
            const MatrixXd turned = b.transpose();
            kernels_.dsymm("L", uplo, &n, &six, &alpha, half.data(), &n, b.data(), &n, &beta, left.data(), &n);
            kernels_.dsymm("R", uplo, &six, &n, &alpha, half.data(), &n, turned.data(), &six, &beta, right.data(),
                           &six);
            EXPECT_LT((left + symmetric * b).cwiseAbs().maxCoeff(), rounding);
            EXPECT_LT((right + turned * symmetric).cwiseAbs().maxCoeff(), rounding);
            for (const char* trans : {"N", "T"}) {
                const MatrixXd a = *trans == 'T' ? matrix(4, n) : matrix(n, 4);
                const int lda = static_cast<int>(a.rows()), four = 4;
                const MatrixXd square = *trans == 'T' ? MatrixXd(a.transpose() * a) : MatrixXd(a * a.transpose());
                const double two = 2.0, one = 1.0;
                MatrixXd c = half;
                kernels_.dsyrk(uplo, trans, &n, &four, &two, a.data(), &lda, &one, c.data(), &n);
                EXPECT_LT((whole(c, lower, false) - whole(half + 2.0 * square, lower, false)).cwiseAbs().maxCoeff(),
                          rounding);
                EXPECT_EQ((c.array().isNaN()).count(), (half.array().isNaN()).count());
            }
        }
}

TEST_P(DenseKernelsTest, TrianglesMultiplyAndSolve)
{
    for (const int n : sizes)
        for (const bool lower : {true, false})
            for (const bool unit : {true, false})
                for (const bool transposed : {true, false})
                    for (const bool left : {true, false}) {
                        const MatrixXd a = triangle(n, lower, unit), plain = whole(a, lower, unit);
                        const MatrixXd op = transposed ? MatrixXd(plain.transpose()) : plain;
                        const int rows = left ? n : 5, columns = left ? 5 : n;
                        const MatrixXd b = matrix(rows, columns);
                        const char *side = left ? "L" : "R", *uplo = lower ? "L" : "U", *trans = transposed ? "T" : "N",
                                   *diag = unit ? "U" : "N";
                        const double alpha = 2.0;
                        MatrixXd product = b, solution = b;
                        kernels_.dtrmm(side, uplo, trans, diag, &rows, &columns, &alpha, a.data(), &n, product.data(),
                                       &rows);
                        kernels_.dtrsm(side, uplo, trans, diag, &rows, &columns, &alpha, a.data(), &n, solution.data(),
                                       &rows);
                        EXPECT_LT((product - 2.0 * (left ? op * b : b * op)).cwiseAbs().maxCoeff(), rounding);
                        EXPECT_LT(((left ? op * solution : solution * op) - 2.0 * b).cwiseAbs().maxCoeff(), rounding);
                        const int stride = 3;
                        MatrixXd x = matrix(3, n);
                        const MatrixXd given = x;
                        kernels_.dtrsv(uplo, trans, diag, &n, a.data(), &n, x.data(), &stride);
                        EXPECT_LT((op * x.row(0).transpose() - given.row(0).transpose()).norm(), rounding);
                        EXPECT_EQ(x.bottomRows(2), given.bottomRows(2));
                    }
}

TEST_P(DenseKernelsTest, CholeskySolvesAndInverts)
{
    for (const int n : sizes)
        for (const char* uplo : {"L", "U"}) {
            const bool lower = *uplo == 'L';
            const MatrixXd a = definite(n), b = matrix(n, 3);
            MatrixXd factor = a, solution = b;
            int info = -1;
            const int three = 3;
            kernels_.dpotrf(uplo, &n, factor.data(), &n, &info);
            ASSERT_EQ(info, 0);
            kernels_.dpotrs(uplo, &n, &three, factor.data(), &n, solution.data(), &n, &info);
            EXPECT_LT((a * solution - b).cwiseAbs().maxCoeff(), rounding);
            MatrixXd inverse_of_factor = factor;
            kernels_.dtrtri(uplo, "N", &n, inverse_of_factor.data(), &n, &info);
            EXPECT_EQ(info, 0);
            EXPECT_LT((whole(inverse_of_factor, lower, false) * whole(factor, lower, false) - MatrixXd::Identity(n, n))
                          .cwiseAbs()
                          .maxCoeff(),
                      rounding);
            kernels_.dpotri(uplo, &n, factor.data(), &n, &info);
            EXPECT_EQ(info, 0);
            EXPECT_LT((whole(factor, lower, false) - whole(a.inverse(), lower, false)).cwiseAbs().maxCoeff(), rounding);
        }
}

TEST_P(DenseKernelsTest, WhatIsNotDefiniteIsNamed)
{
    const int n = 40;
    MatrixXd a = definite(n);
    a(27, 27) = -1.0;
    int info = 0;
    kernels_.dpotrf("L", &n, a.data(), &n, &info);
    EXPECT_EQ(info, 28);
    MatrixXd triangle = MatrixXd::Identity(n, n);
    triangle(3, 3) = 0.0;
    kernels_.dtrtri("L", "N", &n, triangle.data(), &n, &info);
    EXPECT_EQ(info, 4);
}

TEST_P(DenseKernelsTest, EverySetGivesTheSameBits)
{
    const DenseKernels& least = koebe::kernels::baseline();
    const double one = 1.0, alpha = -0.7;
    int info = 0;
    for (const int n : {1, 3, 17, 64, 150, 400}) {
        const int k = 5 * n / 3, few = 3;
        const MatrixXd a = definite(n), b = matrix(n, k), c = matrix(n, few);
        const auto results = [&](const DenseKernels& kernels) {
            std::vector<MatrixXd> r{a, b, c, a, a, c};
            kernels.dpotrf("L", &n, r[0].data(), &n, &info);
            kernels.dtrsm("L", "L", "N", "N", &n, &k, &alpha, r[0].data(), &n, r[1].data(), &n);
            kernels.dtrsm("L", "L", "T", "N", &n, &few, &one, r[0].data(), &n, r[2].data(), &n);
            kernels.dsyrk("L", "N", &n, &k, &alpha, b.data(), &n, &one, r[3].data(), &n);
            kernels.dgemm("N", "T", &n, &n, &k, &alpha, b.data(), &n, r[1].data(), &n, &one, r[4].data(), &n);
            kernels.dgemm("T", "N", &n, &few, &n, &alpha, a.data(), &n, c.data(), &n, &one, r[5].data(), &n);
            return r;
        };
        EXPECT_EQ(results(kernels_), results(least)) << n;
    }
}

TEST_P(DenseKernelsTest, CommonBitsAreCountedOneByOne)
{
    std::uint64_t state = 1;
    const auto column = [&](int rows) {
        std::vector<std::uint64_t> words;
        for (int row = 0; row < rows; ++row) words.push_back(state = state * 6364136223846793005ULL + 1);
        return words;
    };
    for (const int rows : {0, 1, 30, 31, 32, 200})
        for (const int shift : {0, 1, 17, 63}) {
            const auto own = column(rows), left = column(rows), right = column(rows);
            std::int64_t expected = 0;
            for (int row = 0; row < rows; ++row)
                for (int bit = 0; bit < 64; ++bit) {
                    const int from = bit + shift;
                    const std::uint64_t other = from < 64 ? left[row] >> from : right[row] >> (from - 64);
                    expected += static_cast<std::int64_t>(own[row] >> bit & other & 1U);
                }
            EXPECT_EQ(kernels_.common_bits(own.data(), left.data(), right.data(), shift, rows), expected);
        }
}

INSTANTIATE_TEST_SUITE_P(Sets, DenseKernelsTest, testing::ValuesIn(sets()),
                         [](const auto& set) { return std::string(set.param.name); });

}  // namespace
