#include "surface/laplacian.h"

#include "core/length.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace koebe {
namespace {

constexpr std::size_t at_a_time = 32768;  // faces, or vertices, per thread

template <class Positions>
EdgeLengths lengths_of(const Positions& positions, const Triangles& triangles)
{
    EdgeLengths lengths(triangles.rows(), 3);
    in_pieces(static_cast<std::size_t>(triangles.rows()), at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Eigen::Index f = static_cast<Eigen::Index>(begin); f < static_cast<Eigen::Index>(end); ++f)
            for (int k = 0; k < 3; ++k)
                lengths(f, k) = length_of(positions.row(triangles(f, (k + 1) % 3)) - positions.row(triangles(f, k)));
    });
    return lengths;
}

}  // namespace

EdgeLengths edge_lengths(const Vertices& vertices, const Triangles& triangles)
{
    return lengths_of(vertices, triangles);
}

EdgeLengths edge_lengths(const PlanarPoints& points, const Triangles& triangles)
{
    return lengths_of(points, triangles);
}

double triangle_area(double a, double b, double c)
{
    if (a < b) std::swap(a, b);
    if (a < c) std::swap(a, c);
    if (b < c) std::swap(b, c);
    const double squared = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    return squared > 0.0 ? 0.25 * std::sqrt(squared) : 0.0;
}

EdgeLengths half_cotangents(const EdgeLengths& lengths)
{
    EdgeLengths result(lengths.rows(), 3);
    in_pieces(static_cast<std::size_t>(lengths.rows()), at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Eigen::Index f = static_cast<Eigen::Index>(begin); f < static_cast<Eigen::Index>(end); ++f) {
            const double l0 = lengths(f, 0), l1 = lengths(f, 1), l2 = lengths(f, 2);
            const double longest = std::max({l0, l1, l2});
            // A face thinner than 1e-12 of its length acts as one of that thickness: weights stay below about 1e12.
            const double area = std::max(triangle_area(l0, l1, l2), 1e-12 * longest * longest);
            const double scale = area > 0.0 ? 1.0 / (8.0 * area) : 0.0;
            result(f, 0) = scale * (l1 * l1 + l2 * l2 - l0 * l0);
            result(f, 1) = scale * (l2 * l2 + l0 * l0 - l1 * l1);
            result(f, 2) = scale * (l0 * l0 + l1 * l1 - l2 * l2);
        }
    });
    return result;
}

namespace {

/// An entry that a half-edge adds to a row of the Laplacian.
struct RowEntry {
    Index row;
    double weight;
};

/// Sorts some ten entries by row. Stable.
void sort_short(RowEntry* first, RowEntry* last)
{
    for (RowEntry* e = first; e < last; ++e) {
        const RowEntry entry = *e;
        RowEntry* to = e;
        for (; to > first && (to - 1)->row > entry.row; --to) *to = *(to - 1);
        *to = entry;
    }
}

}  // namespace

SparseMatrix cotan_laplacian(const Triangles& triangles, const EdgeLengths& half_cotangents, Index vertex_count)
{
    const Eigen::Index face_count = triangles.rows();

    // Each half-edge adds its weight to both directions, so an inner edge appears twice in each row: gather, sort
    // the short rows, merge.
    std::vector<Index> begin(vertex_count + 1, 0);
    in_ranges(static_cast<std::size_t>(vertex_count), [&](std::size_t from, std::size_t until) {
        for (Eigen::Index i = 0; i < triangles.size(); ++i)
            if (const Index v = triangles.data()[i]; v >= static_cast<Index>(from) && v < static_cast<Index>(until))
                begin[v + 1] += 2;
    });
    for (Index v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
    const auto entries = std::make_unique_for_overwrite<RowEntry[]>(static_cast<std::size_t>(begin[vertex_count]));
    std::vector<Index> cursor(begin.begin(), begin.end() - 1);
    in_ranges(static_cast<std::size_t>(vertex_count), [&](std::size_t from, std::size_t until) {
        const auto add = [&](Index row, Index column, double weight) {
            if (row >= static_cast<Index>(from) && row < static_cast<Index>(until))
                entries[cursor[row]++] = {column, weight};
        };
        for (Eigen::Index f = 0; f < face_count; ++f)
            for (int k = 0; k < 3; ++k) {
                const Index i = triangles(f, k), j = triangles(f, (k + 1) % 3);
                add(i, j, half_cotangents(f, k));
                add(j, i, half_cotangents(f, k));
            }
    });

    SparseMatrix laplacian(vertex_count, vertex_count);
    Index* const place = laplacian.outerIndexPtr();
    std::vector<double> diagonals(vertex_count, 0.0);
    in_pieces(static_cast<std::size_t>(vertex_count), at_a_time, [&](std::size_t from, std::size_t until) {
        for (std::size_t v = from; v < until; ++v) {
            RowEntry* const first = entries.get() + begin[v];
            RowEntry* const last = entries.get() + begin[v + 1];
            sort_short(first, last);
            for (const RowEntry* e = first; e != last; ++e) diagonals[v] += e->weight;
            RowEntry* merged = first;
            for (const RowEntry* e = first; e != last; ++merged) {
                RowEntry sum{e->row, 0.0};
                for (; e != last && e->row == sum.row; ++e) sum.weight += e->weight;
                *merged = sum;
            }
            place[v + 1] = merged == first ? 0 : static_cast<Index>(merged - first) + 1;
        }
    });
    for (Index v = 0; v < vertex_count; ++v) place[v + 1] += place[v];
    laplacian.resizeNonZeros(place[vertex_count]);
    in_pieces(static_cast<std::size_t>(vertex_count), at_a_time, [&](std::size_t from, std::size_t until) {
        for (std::size_t v = from; v < until; ++v) {
            Index* row = laplacian.innerIndexPtr() + place[v];
            double* value = laplacian.valuePtr() + place[v];
            const Index* const end = laplacian.innerIndexPtr() + place[v + 1];
            bool diagonal_written = row == end;
            for (const RowEntry* e = entries.get() + begin[v]; row != end;) {
                const bool other = diagonal_written || (row + 1 != end && e->row < static_cast<Index>(v));
                *row++ = other ? e->row : static_cast<Index>(v);
                *value++ = other ? -e->weight : diagonals[v];
                if (other)
                    ++e;
                else
                    diagonal_written = true;
            }
        }
    });
    return laplacian;
}

LaplacianPlaces::LaplacianPlaces(const Triangles& triangles, const SparseMatrix& laplacian)
{
    const Index* const rows = laplacian.innerIndexPtr();
    const auto place = [&](Index row, Index column) {
        const Index* const first = rows + laplacian.outerIndexPtr()[column];
        const Index* const last = rows + laplacian.outerIndexPtr()[column + 1];
        return static_cast<Index>(std::lower_bound(first, last, row) - rows);
    };
    of_.reserve(static_cast<std::size_t>(triangles.size()));
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index i = triangles(f, k), j = triangles(f, (k + 1) % 3);
            of_.push_back({place(i, j), place(j, i), place(i, i), place(j, j)});
        }
}

void LaplacianPlaces::fill(const EdgeLengths& half_cotangents, SparseMatrix& laplacian) const
{
    double* const values = laplacian.valuePtr();
    std::fill_n(values, laplacian.nonZeros(), 0.0);
    for (std::size_t h = 0; h < of_.size(); ++h) {
        const double weight = half_cotangents.data()[h];
        values[of_[h].there] -= weight;
        values[of_[h].back] -= weight;
        values[of_[h].start] += weight;
        values[of_[h].end] += weight;
    }
}

VectorXd vertex_areas(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count)
{
    VectorXd areas = VectorXd::Zero(vertex_count);
    std::vector<double> thirds(triangles.rows());
    in_pieces(thirds.size(), at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Eigen::Index f = static_cast<Eigen::Index>(begin); f < static_cast<Eigen::Index>(end); ++f)
            thirds[f] = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2)) / 3.0;
    });
    in_ranges(static_cast<std::size_t>(vertex_count), [&](std::size_t begin, std::size_t end) {
        for (Eigen::Index i = 0; i < triangles.size(); ++i)
            if (const Index v = triangles.data()[i]; v >= static_cast<Index>(begin) && v < static_cast<Index>(end))
                areas[v] += thirds[i / 3];
    });
    return areas;
}

}  // namespace koebe
