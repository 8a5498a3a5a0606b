#include "conformal/annulus_map.h"

#include "conformal/closed_disk.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "flow/flat_layout.h"
#include "flow/yamabe_flow.h"
#include "linear/sparse_cholesky.h"
#include "mesh/nearest_first.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

/// Half-edges sorted by origin, in one array.
struct OutgoingHalfedges {
    OutgoingHalfedges(const Triangles& triangles, Index vertex_count)
        : begin(vertex_count + 1, 0), halfedges(triangles.size())
    {
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) ++begin[origin(triangles, h) + 1];
        for (Index v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
        std::vector<Index> cursor(begin.begin(), begin.end() - 1);
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) halfedges[cursor[origin(triangles, h)]++] = h;
    }
    std::vector<Index> begin, halfedges;
};

/// Dijkstra's shortest path (1959) from the outer loop to the nearest vertex of the inner loop.
std::vector<Index> shortest_cut(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                                const VertexLoop& outer, const VertexLoop& inner)
{
    const OutgoingHalfedges outgoing(triangles, vertex_count);
    std::vector<char> goal(vertex_count, 0);
    for (const Index v : inner) goal[v] = 1;
    std::vector<Index> arrival(vertex_count, -1);
    NearestFirst nearest(vertex_count);
    for (const Index v : outer) nearest.reach(v, 0.0);
    for (Index v = nearest.take(); v >= 0; v = nearest.take()) {
        if (goal[v]) {
            std::vector<Index> cut;
            for (Index u = v; arrival[u] >= 0; u = origin(triangles, arrival[u])) cut.push_back(arrival[u]);
            std::reverse(cut.begin(), cut.end());
            return cut;
        }
        for (Index i = outgoing.begin[v]; i < outgoing.begin[v + 1]; ++i) {
            const Index h = outgoing.halfedges[i];
            const Index w = target(triangles, h);
            if (nearest.reach(w, nearest.distance()[v] + lengths.data()[h])) arrival[w] = h;
        }
    }
    throw TopologyError(TopologyKind::disconnected, "no path joins the two loops (vertices of the inner one listed)",
                        inner);
}

/// g0: 1 at the corners of the path's vertices on the right of the path, else 0.
VectorXd jump_across(const Triangles& triangles, const std::vector<Index>& twin, const std::vector<Index>& cut)
{
    VectorXd g0 = VectorXd::Zero(triangles.size());
    for (std::size_t i = 0; i < cut.size(); ++i) {
        // Go clockwise round the path's vertex, from its outgoing edge to its incoming edge or to the boundary.
        const Index stop = i > 0 ? twin[cut[i - 1]] : no_twin;
        for (Index h = cut[i]; h != stop && twin[h] != no_twin;) {
            h = next_halfedge(twin[h]);
            g0[h] = 1.0;
        }
    }
    // Go counter-clockwise round the last vertex, from the edge that enters it to the boundary.
    for (Index h = twin[cut.back()]; h != no_twin; h = twin[previous_halfedge(h)]) g0[h] = 1.0;
    return g0;
}

VectorXd harmonic_between(const SparseMatrix& laplacian, std::vector<char> fixed, const VertexLoop& outer,
                          const VertexLoop& inner)
{
    MatrixXd values = MatrixXd::Zero(laplacian.rows(), 1);
    for (const Index v : outer) fixed[v] = 1;
    for (const Index v : inner) {
        fixed[v] = 1;
        values(v, 0) = 1.0;
    }
    return DirichletSolver(laplacian, fixed).solve(values).col(0);
}

/// g1 with div (dg0 + dg1) = 0 at every vertex, boundary included: K g1 = div dg0, and g1 = 0 at one vertex.
VectorXd harmonic_correction(const SparseMatrix& laplacian, const std::vector<char>& unused, const VectorXd& load,
                             Index pinned)
{
    // The load sums to 0, so a diagonal added at one vertex changes nothing but the constant.
    std::vector<Eigen::Triplet<double, Index>> diagonal{{pinned, pinned, laplacian.coeff(pinned, pinned)}};
    for (Index v = 0; v < static_cast<Index>(unused.size()); ++v)
        if (unused[v]) diagonal.emplace_back(v, v, 1.0);
    SparseMatrix added(laplacian.rows(), laplacian.cols());
    added.setFromTriplets(diagonal.begin(), diagonal.end());
    const SparseMatrix matrix = laplacian + added;
    return SparseCholesky(matrix).solve(load).col(0);
}

/// z = exp(2 pi / k (f + i lambda (g0 + g1))), k = -lambda.
VectorXcd exponential(const Triangles& triangles, const AnnulusMap& map)
{
    constexpr double two_pi = 2.0 * std::numbers::pi;
    VectorXcd positions = VectorXcd::Zero(map.f.size());
    for (Index corner = 0; corner < static_cast<Index>(triangles.size()); ++corner) {
        const Index v = triangles.data()[corner];
        // Any corner gives the same: g0 differs by whole turns.
        positions[v] = std::polar(std::exp(-two_pi / map.lambda * map.f[v]), -two_pi * (map.g0[corner] + map.g1[v]));
    }
    return positions;
}

/// The vector once round a loop, a closed geodesic of the unfolded cylinder.
Complex period_of(const YamabeResult& metric, const VectorXcd& edges, const VertexLoop& loop)
{
    std::vector<char> member(metric.u.size(), 0);
    for (const Index v : loop) member[v] = 1;
    Complex period = 0.0;
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h)
        if (metric.twin[h] == no_twin && member[origin(metric.triangles, h)]) period += edges[h];
    return period;
}

/// Maps by exp(2 pi i w / L) of the flat cylinder.
AnnulusMap map_by_cylinder(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                           const VertexLoop& outer, const VertexLoop& inner, bool flips)
{
    constexpr double two_pi = 2.0 * std::numbers::pi;
    ExecutionContext context;
    const YamabeResult metric =
        yamabe_flow(triangles, lengths, VectorXd::Zero(vertex_count), {.flips = flips, .newton = {}}, context);
    const VectorXcd edges = unfolded_edges(metric.triangles, metric.lengths, metric.twin);
    // A flat cylinder, unrolled; divided by its period, so that one turn is 1.
    VectorXcd strip = positions_along_tree(metric.triangles, edges, vertex_count) / period_of(metric, edges, outer);
    strip.array() -= strip[outer.front()];
    const auto mean_height = [&](const VertexLoop& loop) {
        double sum = 0.0;
        for (const Index v : loop) sum += strip[v].imag();
        return sum / static_cast<double>(loop.size());
    };
    strip.array() -= Complex(0.0, mean_height(outer));

    // z = exp(2 pi i w): the outer loop, at height 0, goes to the unit circle.
    AnnulusMap map;
    map.positions = (Complex(0.0, two_pi) * strip).array().exp();
    const std::vector<char> unused = unused_vertices(triangles, vertex_count);
    for (Index v = 0; v < vertex_count; ++v)
        if (unused[v]) map.positions[v] = 0.0;
    map.inner_radius = std::exp(-two_pi * mean_height(inner));
    map.lambda = 1.0 / mean_height(inner);
    map.converged = metric.converged;
    map.collapsed = static_cast<Index>(metric.collapsed.size());
    map.steps = metric.newton.steps;
    map.curvature_error = metric.newton.residuals.back();
    return map;
}

/// Maps by the holomorphic 1-form.
AnnulusMap map_by_one_form(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                           const VertexLoop& outer, const VertexLoop& inner)
{
    const EdgeLengths weights = half_cotangents(lengths);
    const SparseMatrix laplacian = cotan_laplacian(triangles, weights, vertex_count);
    const std::vector<char> unused = unused_vertices(triangles, vertex_count);

    AnnulusMap map;
    map.cut = shortest_cut(triangles, lengths, vertex_count, outer, inner);
    map.f = harmonic_between(laplacian, unused, outer, inner);
    map.g0 = jump_across(triangles, pair_halfedges(triangles, vertex_count), map.cut);
    const OneForm dg0 = exterior_derivative_of_corners(map.g0);
    map.g1 = harmonic_correction(laplacian, unused, divergence(triangles, weights, dg0, vertex_count),
                                 origin(triangles, map.cut.front()));
    const OneForm dg = dg0 + exterior_derivative(triangles, map.g1);
    const OneForm df = exterior_derivative(triangles, map.f);
    map.lambda = std::sqrt(squared_norm(weights, df) / squared_norm(weights, dg));
    map.inner_radius = std::exp(-2.0 * std::numbers::pi / map.lambda);
    map.positions = exponential(triangles, map);
    return map;
}

}  // namespace

AnnulusMap annulus_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                       const VertexLoop& outer, const VertexLoop& inner, const AnnulusMapOptions& options)
{
    AnnulusMap map = options.backend == AnnulusBackend::yamabe
                         ? map_by_cylinder(triangles, lengths, vertex_count, outer, inner, options.flips)
                         : map_by_one_form(triangles, lengths, vertex_count, outer, inner);
    if (options.inside && map.converged) require_in_closed_disk(map.positions);
    return map;
}

}  // namespace koebe
