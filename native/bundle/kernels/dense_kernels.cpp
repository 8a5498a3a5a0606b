// Compiled once for each instruction set; KOEBE_INSTRUCTION_SET is its name. All sets give the same bits: vectors hold
// independent results, each sum has one order, and products are rounded before they are added (-ffp-contract=off).
// What is inlined elsewhere too is not used here: else the linker would keep one of several equal-named functions, and
// an old processor meet the instructions of a new.
#define KOEBE_JOIN_(a, b) a##b
#define KOEBE_JOIN(a, b) KOEBE_JOIN_(a, b)
#define KOEBE_OF_SET KOEBE_JOIN(of_, KOEBE_INSTRUCTION_SET)

#include "bundle/kernels/dense_kernels.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace koebe::kernels {
namespace KOEBE_OF_SET {
namespace {

using Place = std::ptrdiff_t;

#if defined(__AVX512F__)
constexpr int lanes = 8, tile_columns = 8;
#elif defined(__AVX__)
constexpr int lanes = 4, tile_columns = 4;
#else
constexpr int lanes = 2, tile_columns = 4;
#endif
constexpr int tile_rows = 2 * lanes;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double)), may_alias));
typedef double LanesAnywhere __attribute__((vector_size(lanes * sizeof(double)), aligned(8), may_alias));

// The same in all sets, as sums depend on them.
constexpr int depth = 256;    // products that are summed before they are added to the result
constexpr int triangle = 32;  // columns of a triangle that is solved by itself
constexpr int few = 4;        // columns, for which A is not packed
constexpr int chains = 8;     // sums of a scalar product, each of every eighth product
// Of no effect on the result.
constexpr int packed_rows = 96, packed_columns = 512;

constexpr int least(int a, int b) { return a < b ? a : b; }
constexpr int up_to(int a, int step) { return (a + step - 1) / step * step; }

/// A matrix by the steps from row to row and from column to column.
struct View {
    const double* data;
    Place row_step, column_step;
    double operator()(Place i, Place j) const { return data[i * row_step + j * column_step]; }
    View from(Place i, Place j) const { return {data + i * row_step + j * column_step, row_step, column_step}; }
    View turned() const { return {data, column_step, row_step}; }
};

struct Target {
    double* data;
    Place row_step, column_step;
    double& operator()(Place i, Place j) const { return data[i * row_step + j * column_step]; }
    Target from(Place i, Place j) const { return {data + i * row_step + j * column_step, row_step, column_step}; }
    Target turned() const { return {data, column_step, row_step}; }
    operator View() const { return {data, row_step, column_step}; }
};

/// Memory for packed blocks, aligned for vectors.
class Buffer {
public:
    explicit Buffer(Place count) : memory_(std::malloc(static_cast<std::size_t>(count) * sizeof(double) + 64))
    {
        if (!memory_) throw std::bad_alloc();
        const std::size_t past = reinterpret_cast<std::size_t>(memory_) % 64;
        data_ = reinterpret_cast<double*>(static_cast<char*>(memory_) + (64 - past) % 64);
    }
    ~Buffer() { std::free(memory_); }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    double* data() const { return data_; }

private:
    void* memory_;
    double* data_;
};

/// Panels of so many rows, column by column, the last one filled up with zeros.
template <int Rows>
void pack(View a, int rows, int columns, double* to)
{
    for (int i = 0; i < rows; i += Rows) {
        const int count = least(Rows, rows - i);
        const View panel = a.from(i, 0);
        if (count == Rows && panel.row_step == 1)
            for (int p = 0; p < columns; ++p, to += Rows) {
                const double* column = panel.data + p * panel.column_step;
                for (int r = 0; r < Rows; ++r) to[r] = column[r];
            }
        else
            for (int p = 0; p < columns; ++p, to += Rows) {
                for (int r = 0; r < count; ++r) to[r] = panel(r, p);
                for (int r = count; r < Rows; ++r) to[r] = 0.0;
            }
    }
}

/// The product of two packed panels, column by column.
void multiply_panels(const double* a, const double* b, int inner, double* tile)
{
    Lanes sum[2 * tile_columns] = {};
    for (int p = 0; p < inner; ++p, a += tile_rows, b += tile_columns) {
        const Lanes low = *reinterpret_cast<const Lanes*>(a), high = *reinterpret_cast<const Lanes*>(a + lanes);
#pragma GCC unroll 8
        for (int j = 0; j < tile_columns; ++j) {
            sum[2 * j] += low * b[j];
            sum[2 * j + 1] += high * b[j];
        }
    }
#pragma GCC unroll 16
    for (int j = 0; j < 2 * tile_columns; ++j) *reinterpret_cast<Lanes*>(tile + j * lanes) = sum[j];
}

enum class Share { all, lower };

/// Adds alpha times a tile to a matrix. @param above rows of the tile above the diagonal's in its first column
void add_tile(const double* tile, int rows, int columns, double alpha, int above, Target c)
{
    for (int j = 0; j < columns; ++j) {
        const int first = above + j > 0 ? above + j : 0;
        const double* from = tile + j * tile_rows;
        double* to = &c(0, j);
        if (c.row_step == 1)
            for (int r = first; r < rows; ++r) to[r] += alpha * from[r];
        else
            for (int r = first; r < rows; ++r) to[r * c.row_step] += alpha * from[r];
    }
}

/// The sum of x[i] y[i], eight sums side by side.
double scalar_product(int count, const double* x, const double* y)
{
    alignas(64) double sums[chains];
    Lanes sum[chains / lanes] = {};
    int i = 0;
    for (; i + chains <= count; i += chains) {
#pragma GCC unroll 4
        for (int l = 0; l < chains / lanes; ++l)
            sum[l] += *reinterpret_cast<const LanesAnywhere*>(x + i + l * lanes) *
                      *reinterpret_cast<const LanesAnywhere*>(y + i + l * lanes);
    }
#pragma GCC unroll 4
    for (int l = 0; l < chains / lanes; ++l) *reinterpret_cast<Lanes*>(sums + l * lanes) = sum[l];
    for (int k = 0; i < count; ++i, ++k) sums[k] += x[i] * y[i];
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// C += alpha A B for a few columns, where A is read once: not worth packing.
void add_narrow_product(int m, int n, int k, double alpha, View a, View b, Target c)
{
    const bool by_rows = a.row_step != 1;
    const Buffer buffer(k);
    double* const factors = buffer.data();
    for (int j = 0; j < n; ++j) {
        double* to = &c(0, j);
        for (int p = 0; p < k; ++p) factors[p] = alpha * b(p, j);
        if (by_rows) {
            for (int i = 0; i < m; ++i) to[i] += scalar_product(k, a.data + i * a.row_step, factors);
            continue;
        }
        int p = 0;
        for (; p + 4 <= k; p += 4) {
            const double *first = a.data + p * a.column_step, *second = first + a.column_step,
                         *third = second + a.column_step, *fourth = third + a.column_step;
            const double w = factors[p], x = factors[p + 1], y = factors[p + 2], z = factors[p + 3];
            for (int i = 0; i < m; ++i)
                to[i] = (((to[i] + first[i] * w) + second[i] * x) + third[i] * y) + fourth[i] * z;
        }
        for (; p < k; ++p) {
            const double* column = a.data + p * a.column_step;
            for (int i = 0; i < m; ++i) to[i] += column[i] * factors[p];
        }
    }
}

/// C += alpha A B. @param a (m, k) @param b (k, n) @param part lower: nothing above the diagonal of C is touched
void add_product(int m, int n, int k, double alpha, View a, View b, Target c, Share part = Share::all)
{
    if (m <= 0 || n <= 0 || k <= 0) return;
    if (part == Share::all && c.row_step != 1) {  // by columns of the result
        const View left = b.turned(), right = a.turned();
        return add_product(n, m, k, alpha, left, right, c.turned());
    }
    if (part == Share::all && n < few && (a.row_step == 1 || a.column_step == 1))
        return add_narrow_product(m, n, k, alpha, a, b, c);
    const int inner = least(k, depth), wide = least(n, packed_columns), high = least(m, packed_rows);
    const Place of_b = Place{inner} * up_to(wide, tile_columns), of_a = Place{inner} * up_to(high, tile_rows);
    const Buffer buffer(of_a + of_b + 8);
    double* const packed_b = buffer.data();
    double* const packed_a = packed_b + (of_b + 7) / 8 * 8;
    alignas(64) double tile[tile_rows * tile_columns];
    for (int j0 = 0; j0 < n; j0 += packed_columns)
        for (int p0 = 0; p0 < k; p0 += depth) {
            const int columns = least(packed_columns, n - j0), steps = least(depth, k - p0);
            pack<tile_columns>(b.from(p0, j0).turned(), columns, steps, packed_b);
            const int top = part == Share::lower ? j0 / packed_rows * packed_rows : 0;
            for (int i0 = top; i0 < m; i0 += packed_rows) {
                const int rows = least(packed_rows, m - i0);
                pack<tile_rows>(a.from(i0, p0), rows, steps, packed_a);
                for (int j = 0; j < columns; j += tile_columns)
                    for (int i = 0; i < rows; i += tile_rows) {
                        const int above = part == Share::lower ? j0 + j - i0 - i : -tile_columns;
                        if (above >= tile_rows) continue;
                        multiply_panels(packed_a + Place{i} * steps, packed_b + Place{j} * steps, steps, tile);
                        add_tile(tile, least(tile_rows, rows - i), least(tile_columns, columns - j), alpha, above,
                                 c.from(i0 + i, j0 + j));
                    }
            }
        }
}

bool is(const char* option, char letter) { return *option == letter || *option == letter + ('a' - 'A'); }

View given(const double* a, const int* lda, const char* trans)
{
    const View view{a, 1, *lda};
    return is(trans, 'N') ? view : view.turned();
}

/// c *= beta, where 0 clears what may be no number. @param part lower: on and below the diagonal
void scale(int m, int n, double beta, Target c, Share part = Share::all)
{
    if (beta == 1.0) return;
    for (int j = 0; j < n; ++j)
        for (int i = part == Share::lower ? j : 0; i < m; ++i) c(i, j) = beta == 0.0 ? 0.0 : beta * c(i, j);
}

/// A triangle of at most `triangle` rows, in the order in which a solution goes through it.
struct SmallTriangle {
    int order;
    double factors[triangle * triangle], inverse[triangle];
};

/// So many vectors of right-hand sides, the last ones filled up with zeros. @param b its rows in the triangle's order
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

/// Solves T X = B in place, T a triangle of at most `triangle` rows. @param forward T is lower
void solve_small(int n, int count, View t, bool forward, bool unit, Target b)
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

/// How many columns the first half of a large triangle has.
int half(int n) { return up_to(n / 2, triangle); }

/// Solves T X = B in place, by halves. @param t (n, n) a triangle @param forward it is lower
void solve_triangle(int n, int count, View t, bool forward, bool unit, Target b)
{
    if (n <= triangle) return solve_small(n, count, t, forward, unit, b);
    const int first = forward ? half(n) : n - half(n), at = forward ? 0 : n - first;
    const int rest = forward ? first : 0;
    solve_triangle(first, count, t.from(at, at), forward, unit, b.from(at, 0));
    add_product(n - first, count, first, -1.0, t.from(rest, at), b.from(at, 0), b.from(rest, 0));
    solve_triangle(n - first, count, t.from(rest, rest), forward, unit, b.from(rest, 0));
}

/// The Cholesky factor of at most `triangle` columns. @return the number of the first bad minor, or 0
int factorize_small(int n, Target a)
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

/// The Cholesky factor of the lower triangle in its place, by halves. @return the first bad minor's number, or 0
int factorize(int n, Target a)
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

/// B = alpha T B in place, T a triangle. @param lower it is
void multiply_triangle(int n, int count, double alpha, View t, bool lower, bool unit, Target b)
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

/// A triangle and a matrix as "triangle times matrix", which is "matrix times triangle" turned.
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
    };
    return kernels;
}

}  // namespace koebe::kernels
