// Solves, multiplies and makes triangles by halves, down to a few columns. For dense_kernels.cpp alone, which is
// compiled for each set.
#pragma once

#include "kernels/dense_product.h"

namespace koebe::kernels {
namespace KOEBE_OF_SET {

constexpr int triangle = 32;  // equal in all sets: columns of a triangle that is not halved

/// A triangle of at most `triangle` rows, in the order in which a solution uses them.
struct SmallTriangle {
    int order;
    double factors[triangle * triangle], inverse[triangle];
};

/// Solves for some vectors of right-hand sides, the last ones padded with zeros. @param b rows in the triangle's order
template <int Vectors>
void solve_some(const SmallTriangle& t, int count, Target b)
{
    constexpr int width = Vectors * lanes;
    alignas(64) double x[triangle * width];
    for (int i = 0; i < t.order; ++i) {
        double* own = x + i * width;
        for (int r = 0; r < count; ++r) own[r] = b(i, r);
        for (int r = count; r < width; ++r) own[r] = 0.0;
        Lanes sum[Vectors];
#pragma GCC unroll 4
        for (int l = 0; l < Vectors; ++l) sum[l] = *reinterpret_cast<Lanes*>(own + l * lanes);
        for (int j = 0; j < i; ++j) {
#pragma GCC unroll 4
            for (int l = 0; l < Vectors; ++l)
                sum[l] -= t.factors[i * triangle + j] * *reinterpret_cast<const Lanes*>(x + j * width + l * lanes);
        }
#pragma GCC unroll 4
        for (int l = 0; l < Vectors; ++l) *reinterpret_cast<Lanes*>(own + l * lanes) = sum[l] * t.inverse[i];
        for (int r = 0; r < count; ++r) b(i, r) = own[r];
    }
}

/// Solves T X = B in place for a triangle T of at most `triangle` rows. @param forward T is lower
static void solve_small(int n, int count, View t, bool forward, bool unit, Target b)
{
    SmallTriangle small;
    small.order = n;
    const auto row = [&](int i) { return forward ? i : n - 1 - i; };
    for (int i = 0; i < n; ++i) {
        small.inverse[i] = unit ? 1.0 : 1.0 / t(row(i), row(i));
        for (int j = 0; j < i; ++j) small.factors[i * triangle + j] = t(row(i), row(j));
    }
    Target rows = forward ? b : Target{&b(n - 1, 0), -b.row_step, b.column_step};
    constexpr int many = 4;
    while (count > 0) {
        const int width = count > lanes ? many * lanes : lanes, here = least(width, count);
        if (width == lanes)
            solve_some<1>(small, here, rows);
        else
            solve_some<many>(small, here, rows);
        count -= here;
        rows = rows.from(0, here);
    }
}

/// The number of columns in the first half of a large triangle.
static int half(int n) { return up_to(n / 2, triangle); }

/// Solves T X = B in place, by halves. @param t (n, n) a triangle @param forward T is lower
static void solve_triangle(int n, int count, View t, bool forward, bool unit, Target b)
{
    if (n <= triangle) return solve_small(n, count, t, forward, unit, b);
    const int first = forward ? half(n) : n - half(n), at = forward ? 0 : n - first;
    const int rest = forward ? first : 0;
    solve_triangle(first, count, t.from(at, at), forward, unit, b.from(at, 0));
    add_product(n - first, count, first, -1.0, t.from(rest, at), b.from(at, 0), b.from(rest, 0));
    solve_triangle(n - first, count, t.from(rest, rest), forward, unit, b.from(rest, 0));
}

/// Cholesky factor of at most `triangle` columns. @return the number of the first bad minor, or 0
static int factorize_small(int n, Target a)
{
    double own[triangle * triangle];
    for (int j = 0; j < n; ++j)
        for (int i = j; i < n; ++i) own[i + j * triangle] = a(i, j);
    for (int j = 0; j < n; ++j) {
        double* const column = own + j * triangle;
        if (!(column[j] > 0.0)) return j + 1;
        const double pivot = __builtin_sqrt(column[j]), inverse = 1.0 / pivot;
        column[j] = pivot;
        for (int i = j + 1; i < n; ++i) column[i] *= inverse;
        for (int c = j + 1; c < n; ++c) {
            double* const other = own + c * triangle;
            for (int i = c; i < n; ++i) other[i] -= column[c] * column[i];
        }
    }
    for (int j = 0; j < n; ++j)
        for (int i = j; i < n; ++i) a(i, j) = own[i + j * triangle];
    return 0;
}

/// Cholesky factor of the lower triangle in place, by halves. @return the number of the first bad minor, or 0
static int factorize(int n, Target a)
{
    if (n <= triangle) return factorize_small(n, a);
    const int first = half(n), others = n - first;
    if (const int bad = factorize(first, a); bad > 0) return bad;
    const Target below = a.from(first, 0), corner = a.from(first, first);
    solve_triangle(first, others, a, true, false, below.turned());
    add_product(others, others, first, -1.0, below, View(below).turned(), corner, Share::lower);
    const int bad = factorize(others, corner);
    return bad > 0 ? first + bad : 0;
}

/// B = alpha T B in place for a triangle T. @param lower T is lower
static void multiply_triangle(int n, int count, double alpha, View t, bool lower, bool unit, Target b)
{
    double whole[triangle * triangle];
    const Buffer buffer(Place{triangle} * count);
    double* const before = buffer.data();
    for (int done = 0; done < n; done += triangle) {
        const int width = least(triangle, n - done), others = n - done - width;
        const int at = lower ? others : done, other = lower ? 0 : at + width;
        for (int j = 0; j < width; ++j)
            for (int i = 0; i < width; ++i)
                whole[i + j * triangle] = i == j                    ? (unit ? 1.0 : t(at + i, at + i))
                                          : (lower ? i > j : i < j) ? t(at + i, at + j)
                                                                    : 0.0;
        for (int c = 0; c < count; ++c)
            for (int i = 0; i < width; ++i) {
                before[i + Place{c} * triangle] = b(at + i, c);
                b(at + i, c) = 0.0;
            }
        add_product(width, count, width, alpha, View{whole, 1, triangle}, View{before, 1, triangle}, b.from(at, 0));
        add_product(width, count, others, alpha, t.from(at, other), b.from(other, 0), b.from(at, 0));
    }
}

}  // namespace KOEBE_OF_SET
}  // namespace koebe::kernels
