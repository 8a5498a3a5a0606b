#include "surface/free_flattening.h"

#include "core/errors.h"
#include "surface/laplacian.h"

#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>

namespace koebe {
namespace {

constexpr double least_relative_height = 1e-3;  // of the longest edge, dimensionless

/// A face laid into the plane, counter-clockwise, scaled to area 1/2.
std::array<Complex, 3> lay_flat(double l01, double l12, double l20)
{
    const double longest = std::max({l01, l12, l20});
    if (!(longest > 0.0)) return {Complex(0.0, 0.0), Complex(1.0, 0.0), Complex(0.0, 1.0)};
    const double area = std::max(triangle_area(l01, l12, l20), 0.5 * least_relative_height * longest * longest);
    const double base = std::max(l01, least_relative_height * longest);
    const double x = (base * base + l20 * l20 - l12 * l12) / (2.0 * base), y = 2.0 * area / base;
    const double scale = 1.0 / std::sqrt(2.0 * area);
    return {Complex(0.0, 0.0), Complex(scale * base, 0.0), scale * Complex(x, y)};
}

}  // namespace

VectorXcd flatten_freely(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& pinned,
                         const std::vector<Complex>& images)
{
    const EdgeLengths lengths = edge_lengths(vertices, triangles);
    const Index vertex_count = static_cast<Index>(vertices.rows());
    VectorXcd image = VectorXcd::Zero(vertex_count);
    std::vector<Index> unknown(vertex_count, 0);
    for (std::size_t i = 0; i < pinned.size(); ++i) {
        image[pinned[i]] = images[i];
        unknown[pinned[i]] = -1;
    }
    Index count = 0;
    for (Index& u : unknown)
        if (u == 0) u = count++;

    // LSCM: a map of a flat triangle p is conformal if and only if the sum of W_k z_k is 0, W_k = p_{k+2} - p_{k+1}.
    std::vector<Eigen::Triplet<Complex, Index>> entries;
    VectorXcd right = VectorXcd::Zero(triangles.rows());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const auto p = lay_flat(lengths(f, 0), lengths(f, 1), lengths(f, 2));
        for (int k = 0; k < 3; ++k) {
            const Complex weight = p[(k + 2) % 3] - p[(k + 1) % 3];
            const Index v = triangles(f, k);
            if (unknown[v] >= 0)
                entries.emplace_back(static_cast<Index>(f), unknown[v], weight);
            else
                right[f] -= weight * image[v];
        }
    }
    if (count == 0) return image;
    // Least squares, by the normal equations.
    using ComplexMatrix = Eigen::SparseMatrix<Complex, Eigen::ColMajor, Index>;
    ComplexMatrix system(static_cast<Index>(triangles.rows()), count);
    system.setFromTriplets(entries.begin(), entries.end());
    const ComplexMatrix normal = system.adjoint() * system;
    Eigen::SimplicialLDLT<ComplexMatrix> solver(normal);
    if (solver.info() != Eigen::Success) throw SolverError("a part joined by one edge cannot be flattened");
    const VectorXcd solution = solver.solve(system.adjoint() * right);
    for (Index v = 0; v < vertex_count; ++v)
        if (unknown[v] >= 0) image[v] = solution[unknown[v]];
    return image;
}

}  // namespace koebe
