#include "pipeline/domain.h"

#include "core/errors.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace koebe {
namespace {

/// Length of the edge from each vertex of a loop to the next. Vertices that coincide in space still need an angle of
/// their own, so no edge counts for less than 1e-9 of the mean.
VectorXd loop_edges(const Vertices& vertices, const VertexLoop& loop)
{
    VectorXd edges(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i)
        edges[i] = (vertices.row(loop[(i + 1) % loop.size()]) - vertices.row(loop[i])).stableNorm();
    return edges.cwiseMax(1e-9 * edges.mean());
}

int choose_outer_loop(const Domain& domain, const UniformizeOptions& options)
{
    const auto& loops = domain.surface.loops;
    if (options.outer == OuterLoop::vertex) {
        const auto compact = std::find(domain.original.begin(), domain.original.end(), options.outer_vertex);
        const Index vertex = static_cast<Index>(compact - domain.original.begin());
        for (std::size_t k = 0; k < loops.size(); ++k)
            if (std::find(loops[k].begin(), loops[k].end(), vertex) != loops[k].end()) return static_cast<int>(k);
        throw InputError("vertex " + std::to_string(options.outer_vertex) + " lies on no boundary loop",
                         {options.outer_vertex});
    }
    int longest = 0;
    double length = 0.0;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (const double l = loop_edges(domain.vertices, loops[k]).sum(); l > length) {
            length = l;
            longest = static_cast<int>(k);
        }
    return longest;
}

}  // namespace

Domain prepare_domain(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    validate_arrays(vertices, triangles);
    Domain domain;
    domain.surface = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));

    std::vector<Index> rank(vertices.rows(), 0);
    for (const Index v : domain.surface.unused) rank[v] = -1;
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v)
        if (rank[v] == 0) {
            rank[v] = static_cast<Index>(domain.original.size());
            domain.original.push_back(v);
        }
    // Centred and scaled, so that no length overflows and the result does not depend on the unit.
    domain.vertices = vertices(domain.original, Eigen::all);
    domain.vertices.rowwise() -= domain.vertices.colwise().mean().eval();
    const double scale = domain.vertices.cwiseAbs().maxCoeff();
    if (!(scale > 0.0)) throw InputError("all vertices lie on one point");
    domain.vertices /= scale;
    if (!domain.surface.unused.empty()) {
        for (Index* i = domain.surface.triangles.data(); i != domain.surface.triangles.data() + 3 * triangles.rows();
             ++i)
            *i = rank[*i];
        for (VertexLoop& loop : domain.surface.loops)
            for (Index& v : loop) v = rank[v];
        domain.surface.vertex_count = static_cast<Index>(domain.original.size());
    }

    domain.outer_rank = choose_outer_loop(domain, options);
    std::vector<int> order(domain.surface.loops.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> length;
    for (const VertexLoop& loop : domain.surface.loops) length.push_back(loop_edges(domain.vertices, loop).sum());
    length[domain.outer_rank] = std::numeric_limits<double>::infinity();
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[a] > length[b]; });
    for (const int k : order) {
        domain.loops.push_back(domain.surface.loops[k]);
        domain.edges.push_back(loop_edges(domain.vertices, domain.loops.back()));
    }
    return domain;
}

Domain core_domain(const Domain& whole, FlapCut& cut)
{
    Domain core;
    core.surface = std::move(cut.core);
    core.vertices = whole.vertices(cut.vertices, Eigen::all);
    for (const Index v : cut.vertices) core.original.push_back(whole.original[v]);
    core.loops = cut.loops;
    for (const VertexLoop& loop : core.loops) core.edges.push_back(loop_edges(core.vertices, loop));
    core.outer_rank = whole.outer_rank;
    return core;
}

}  // namespace koebe
