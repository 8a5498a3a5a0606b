#include "fit/quasiconformal_map.h"

#include "circles/circle_fit.h"
#include "circles/crowded_circles.h"
#include "core/complex_places.h"
#include "core/numbering.h"
#include "iteration/koebe_condensed.h"
#include "shape/domain_alignment.h"
#include "surface/laplacian.h"

#include <cmath>

namespace koebe {
namespace {

/// (F, 3) lengths in the metric of each face: those of an edge on its two sides differ.
EdgeLengths bent_lengths(const Triangles& triangles, const PlanarPoints& uv, const VectorXcd& mu)
{
    EdgeLengths lengths(triangles.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int corner = 0; corner < 3; ++corner) {
            const Complex edge = complex_at(uv, triangles(f, (corner + 1) % 3)) - complex_at(uv, triangles(f, corner));
            lengths(f, corner) = std::abs(edge + mu[f] * std::conj(edge));
        }
    return lengths;
}

/// Per loop the length of the edge from each vertex to the next.
std::vector<VectorXd> rim_lengths(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                                  const std::vector<VertexLoop>& loops)
{
    std::vector<Index> next(static_cast<std::size_t>(vertex_count), -1);
    for (const VertexLoop& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) next[loop[i]] = loop[(i + 1) % loop.size()];
    VectorXd from = VectorXd::Zero(vertex_count);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int corner = 0; corner < 3; ++corner)
            if (next[triangles(f, corner)] == triangles(f, (corner + 1) % 3))
                from[triangles(f, corner)] = lengths(f, corner);
    std::vector<VectorXd> result;
    for (const VertexLoop& loop : loops) result.push_back(from(loop));
    return result;
}

}  // namespace

std::optional<PlanarPoints> quasiconformal_map(const Triangles& triangles, const PlanarPoints& uv,
                                               const std::vector<VertexLoop>& loops, const VectorXcd& mu,
                                               const std::vector<Circle>& goal, ExecutionContext& context)
{
    // The conformal map of the metric: images of the rims, and their circles.
    const auto count = static_cast<Index>(uv.rows());
    const EdgeLengths lengths = bent_lengths(triangles, uv, mu);
    const SparseMatrix laplacian = cotan_laplacian(triangles, half_cotangents(lengths), count);
    const IterationOptions options;
    const FactoredSurface surface = condense(laplacian, loops, options);
    const KoebeOutcome outcome =
        koebe_condensed(laplacian, surface, loops, rim_lengths(triangles, lengths, count, loops),
                        vertex_areas(triangles, lengths, count), options, context);
    if (!outcome.converged || outcome.raised_angles > 0) return {};
    std::vector<Circle> circles{Circle{}};
    for (std::size_t k = 1; k < loops.size(); ++k) circles.push_back(fit_circle_least_squares(outcome.loops[k]));
    if (!circles_apart(circles)) return {};
    // The rims on the goal's circles, and the inside.
    const Moebius nearest = align_domains(goal, circles, numbers_below<int>(goal.size()), context).map;
    MatrixXd rim(surface.solver().boundary_size(), 2);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const Circle from = nearest(circles[k]);
        for (const Complex z : nearest(outcome.loops[k])) {
            const Complex arm = z - from.center, place = goal[k].center + goal[k].radius * arm / std::abs(arm);
            rim.row(row++) << place.real(), place.imag();
        }
    }
    return PlanarPoints(surface.solver().extend(rim));
}

}  // namespace koebe
