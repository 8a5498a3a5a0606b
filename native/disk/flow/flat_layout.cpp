#include "flow/flat_layout.h"

#include "core/connectivity.h"
#include "linear/sparse_cholesky.h"

#include <cmath>
#include <utility>

namespace koebe {
namespace {

/// Fills in a face's edges from the direction of one edge.
void lay_face(const EdgeLengths& lengths, Index h, Complex direction, VectorXcd& edges)
{
    const Index next = next_halfedge(h), previous = previous_halfedge(h);
    const double a = lengths.data()[h], b = lengths.data()[next], c = lengths.data()[previous];
    const double area = triangle_area(a, b, c);
    // The corner at the origin of h, between a and c.
    const double angle = std::atan2(4.0 * area, a * a + (c - b) * (c + b));
    edges[h] = a * direction;
    edges[previous] = -c * direction * std::polar(1.0, angle);
    edges[next] = -edges[h] - edges[previous];
}

}  // namespace

VectorXcd unfolded_edges(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<Index>& twin)
{
    VectorXcd edges = VectorXcd::Zero(triangles.size());
    std::vector<char> laid(triangles.rows(), 0);
    std::vector<Index> queue{0};
    lay_face(lengths, 0, 1.0, edges);
    laid[0] = 1;
    for (std::size_t i = 0; i < queue.size(); ++i)
        for (Index h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
            const Index t = twin[h];
            if (t == no_twin || laid[face_of(t)]) continue;
            laid[face_of(t)] = 1;
            const double length = std::abs(edges[h]);
            lay_face(lengths, t, length > 0.0 ? -edges[h] / length : Complex(1.0, 0.0), edges);
            queue.push_back(face_of(t));
        }
    return edges;
}

VectorXcd positions_from_edges(const Triangles& triangles, const EdgeLengths& lengths, const VectorXcd& edges,
                               Index vertex_count)
{
    const EdgeLengths weights = lengths.array().inverse();
    SparseMatrix laplacian = cotan_laplacian(triangles, weights, vertex_count);
    MatrixXd load = MatrixXd::Zero(vertex_count, 2);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        const Complex weighted = weights.data()[h] * edges[h];
        load.row(target(triangles, h)) += Eigen::RowVector2d(weighted.real(), weighted.imag());
        load.row(origin(triangles, h)) -= Eigen::RowVector2d(weighted.real(), weighted.imag());
    }
    const VectorXd diagonal = laplacian.diagonal();
    std::vector<Eigen::Triplet<double, Index>> added{
        {origin(triangles, 0), origin(triangles, 0), diagonal[origin(triangles, 0)]}};
    for (Index v = 0; v < vertex_count; ++v)
        if (diagonal[v] == 0.0) added.emplace_back(v, v, 1.0);
    SparseMatrix ground(vertex_count, vertex_count);
    ground.setFromTriplets(added.begin(), added.end());
    const MatrixXd points = SparseCholesky(laplacian + ground).solve(load);
    return points.col(0) + Complex(0.0, 1.0) * points.col(1);
}

VectorXcd positions_along_tree(const Triangles& triangles, const VectorXcd& edges, Index vertex_count)
{
    VectorXcd positions = VectorXcd::Zero(vertex_count);
    std::vector<std::vector<Index>> leaving(vertex_count), arriving(vertex_count);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        leaving[origin(triangles, h)].push_back(h);
        arriving[target(triangles, h)].push_back(h);
    }
    std::vector<char> reached(vertex_count, 0);
    std::vector<Index> queue{origin(triangles, 0)};
    reached[queue[0]] = 1;
    const auto reach = [&](Index v, Complex position) {
        if (std::exchange(reached[v], 1)) return;
        positions[v] = position;
        queue.push_back(v);
    };
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const Index v = queue[i];
        for (const Index h : leaving[v]) reach(target(triangles, h), positions[v] + edges[h]);
        for (const Index h : arriving[v]) reach(origin(triangles, h), positions[v] - edges[h]);
    }
    return positions;
}

}  // namespace koebe
