// C += alpha A B, in blocks that fit the caches. For dense_kernels.cpp alone, which is compiled for each set.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace koebe::kernels {
namespace KOEBE_OF_SET {

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

// Equal in all sets, as sums depend on them.
constexpr int depth = 256;  // products summed before they are added to the result
constexpr int few = 4;      // columns; with fewer, A is not packed
constexpr int chains = 8;   // sums of a scalar product, each of every eighth product
// These do not affect the result.
constexpr int packed_rows = 96, packed_columns = 512;

constexpr int least(int a, int b) { return a < b ? a : b; }
constexpr int up_to(int a, int step) { return (a + step - 1) / step * step; }

/// A matrix by its steps from row to row and from column to column.
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

/// Packs panels of `Rows` rows, column by column, the last one padded with zeros.
template <int Rows>
static void pack(View a, int rows, int columns, double* to)
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

/// Multiplies two packed panels, column by column.
static void multiply_panels(const double* a, const double* b, int inner, double* tile)
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

/// Adds alpha times a tile to a matrix. @param above rows of the tile's first column that are above the diagonal
static void add_tile(const double* tile, int rows, int columns, double alpha, int above, Target c)
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

/// The sum of x[i] y[i], computed as eight sums side by side.
static double scalar_product(int count, const double* x, const double* y)
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

/// C += alpha A B for a few columns. A is read once, so packing is not worth it.
static void add_narrow_product(int m, int n, int k, double alpha, View a, View b, Target c)
{
    const bool by_rows = a.row_step != 1;
    const Buffer buffer(k);
    double* const factors = buffer.data();
    for (int j = 0; j < n; ++j) {
        double* to = &c(0, j);
        for (int p = 0; p < k; ++p) factors[p] = alpha * b(p, j);
        // A's rows lie in one piece: scalar products.
        if (by_rows) {
            for (int i = 0; i < m; ++i) to[i] += scalar_product(k, a.data + i * a.row_step, factors);
            continue;
        }
        // A's columns lie in one piece: four at a time, as C's column is then read and written a quarter as often.
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

/// C += alpha A B. @param a (m, k) @param b (k, n) @param part lower: does not change C above the diagonal
static void add_product(int m, int n, int k, double alpha, View a, View b, Target c, Share part = Share::all)
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

}  // namespace KOEBE_OF_SET
}  // namespace koebe::kernels
