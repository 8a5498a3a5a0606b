#include "foldover/convex_embedding.h"

#include "conformal/stored_uv.h"
#include "geometry/laplacian.h"
#include "geometry/sparse_cholesky.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr int most_rounds = 16;
constexpr double softest = 1e-9, hardest = 1e9;  // weights of edges, over the usual one

/// Triangles that are not upright, or not so once stored.
Eigen::Index count_wrong(const Triangles& triangles, const PlanarPoints& points)
{
    Eigen::Index wrong = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) wrong += StoredFace(triangles, points, f).flipped();
    return wrong;
}

}  // namespace

FilledSurface fill_with_fans(const Surface& surface, const std::vector<VertexLoop>& loops)
{
    Eigen::Index row = surface.triangles.rows(), count = row;
    for (std::size_t k = 1; k < loops.size(); ++k) count += static_cast<Eigen::Index>(loops[k].size());
    FilledSurface filled{Triangles(count, 3), surface.vertex_count, surface.vertex_count};
    filled.triangles.topRows(row) = surface.triangles;
    for (std::size_t k = 1; k < loops.size(); ++k) {
        const Index center = filled.vertex_count++;
        for (std::size_t i = 0; i < loops[k].size(); ++i)
            filled.triangles.row(row++) << loops[k][(i + 1) % loops[k].size()], loops[k][i], center;
    }
    return filled;
}

PlanarPoints convex_embedding(const FilledSurface& filled, const VertexLoop& outer, const VectorXcd& rim)
{
    std::vector<char> fixed(filled.vertex_count, 0);
    MatrixXd given = MatrixXd::Zero(filled.vertex_count, 2);
    for (std::size_t i = 0; i < outer.size(); ++i) {
        fixed[outer[i]] = 1;
        given.row(outer[i]) << rim[static_cast<Eigen::Index>(i)].real(), rim[static_cast<Eigen::Index>(i)].imag();
    }
    EdgeLengths weights = EdgeLengths::Constant(filled.triangles.rows(), 3, 1.0);
    PlanarPoints best;
    Eigen::Index least = -1;
    for (int round = 0; round < most_rounds; ++round) {
        const SparseMatrix laplacian = cotan_laplacian(filled.triangles, weights, filled.vertex_count);
        const PlanarPoints points = DirichletSolver(laplacian, fixed).solve(given);
        if (!points.allFinite()) break;
        const Eigen::Index wrong = count_wrong(filled.triangles, points);
        if (least < 0 || wrong < least) {
            best = points;
            least = wrong;
        }
        if (least == 0) break;
        const EdgeLengths lengths = edge_lengths(points, filled.triangles);
        const double usual = lengths.mean();
        for (Eigen::Index e = 0; e < weights.size(); ++e)
            weights.data()[e] *= std::clamp(lengths.data()[e] / usual, 1e-3, 10.0);
        weights = (weights / weights.mean()).cwiseMax(softest).cwiseMin(hardest).eval();
    }
    return best;
}

}  // namespace koebe
