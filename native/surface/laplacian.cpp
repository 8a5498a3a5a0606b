#include "surface/laplacian.h"

#include "core/length.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace koebe {
namespace {

/// One end of a half-edge as the row of the other end has it.
struct Entry {
    Index row;
    double weight;
};

/// By row, equal ones in their order. Rows are short: a few entries for each neighbour.
void sort_row(std::vector<Entry>::iterator first, std::vector<Entry>::iterator last)
{
    constexpr std::ptrdiff_t few = 40;
    const auto by_row = [](const Entry& a, const Entry& b) { return a.row < b.row; };
    if (last - first > few) return std::stable_sort(first, last, by_row);
    for (auto next = first; next != last; ++next) {
        const Entry entry = *next;
        auto place = next;
        for (; place != first && by_row(entry, *(place - 1)); --place) *place = *(place - 1);
        *place = entry;
    }
}

template <class Positions>
EdgeLengths lengths_of(const Positions& positions, const Triangles& triangles)
{
    EdgeLengths lengths(triangles.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            lengths(f, k) = length_of(positions.row(triangles(f, (k + 1) % 3)) - positions.row(triangles(f, k)));
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
    for (Eigen::Index f = 0; f < lengths.rows(); ++f) {
        const double l0 = lengths(f, 0), l1 = lengths(f, 1), l2 = lengths(f, 2);
        const double longest = std::max({l0, l1, l2});
        // A face thinner than 1e-12 of its length acts as one of that thickness: weights stay below about 1e12.
        const double area = std::max(triangle_area(l0, l1, l2), 1e-12 * longest * longest);
        const double scale = area > 0.0 ? 1.0 / (8.0 * area) : 0.0;
        result(f, 0) = scale * (l1 * l1 + l2 * l2 - l0 * l0);
        result(f, 1) = scale * (l2 * l2 + l0 * l0 - l1 * l1);
        result(f, 2) = scale * (l0 * l0 + l1 * l1 - l2 * l2);
    }
    return result;
}

SparseMatrix cotan_laplacian(const Triangles& triangles, const EdgeLengths& half_cotangents, Index vertex_count)
{
    const Eigen::Index face_count = triangles.rows();

    // Each half-edge adds its weight to both directions, so an inner edge appears twice in each row: gather, sort
    // the short rows, merge.
    std::vector<Index> begin(vertex_count + 1, 0);
    for (Eigen::Index i = 0; i < triangles.size(); ++i) begin[triangles.data()[i] + 1] += 2;
    for (Index v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
    std::vector<Entry> entries(begin[vertex_count]);
    std::vector<Index> cursor(begin.begin(), begin.end() - 1);
    for (Eigen::Index f = 0; f < face_count; ++f)
        for (int k = 0; k < 3; ++k) {
            const Index i = triangles(f, k), j = triangles(f, (k + 1) % 3);
            entries[cursor[i]++] = {j, half_cotangents(f, k)};
            entries[cursor[j]++] = {i, half_cotangents(f, k)};
        }

    SparseMatrix laplacian(vertex_count, vertex_count);
    laplacian.reserve(entries.size() / 2 + 2 * vertex_count);
    for (Index v = 0; v < vertex_count; ++v) {
        laplacian.startVec(v);
        const auto first = entries.begin() + begin[v], last = entries.begin() + begin[v + 1];
        sort_row(first, last);
        double diagonal = 0.0;
        for (auto e = first; e != last; ++e) diagonal += e->weight;
        bool diagonal_written = first == last;
        for (auto e = first; e != last;) {
            double weight = 0.0;
            const Index row = e->row;
            for (; e != last && e->row == row; ++e) weight += e->weight;
            if (!diagonal_written && row > v) {
                laplacian.insertBack(v, v) = diagonal;
                diagonal_written = true;
            }
            laplacian.insertBack(row, v) = -weight;
        }
        if (!diagonal_written) laplacian.insertBack(v, v) = diagonal;
    }
    laplacian.finalize();
    return laplacian;
}

VectorXd vertex_areas(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count)
{
    VectorXd areas = VectorXd::Zero(vertex_count);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const double third = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2)) / 3.0;
        for (int k = 0; k < 3; ++k) areas[triangles(f, k)] += third;
    }
    return areas;
}

}  // namespace koebe
