#include "pipeline/domain.h"

#include "core/errors.h"
#include "pipeline/canonical_form.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace koebe {
namespace {

constexpr double same_length = 1e-9;  // relative difference of loops that are equally long

/// The loop that the options name, in the surface's own order.
std::size_t choose_outer_loop(const Domain& domain, const UniformizeOptions& options)
{
    const auto& loops = domain.surface.loops;
    if (options.outer == OuterLoop::vertex) {
        for (std::size_t k = 0; k < loops.size(); ++k)
            for (const Index v : loops[k])
                if (domain.original[v] == options.outer_vertex) return k;
        throw InputError("vertex " + std::to_string(options.outer_vertex) + " lies on no boundary loop",
                         ElementKind::vertices, {options.outer_vertex});
    }
    std::size_t longest = 0;
    double length = 0.0;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (const double l = loop_edges(domain.vertices, loops[k]).sum(); l > (1.0 + same_length) * length) {
            length = l;
            longest = k;
        }
    return longest;
}

}  // namespace

Domain prepare_domain(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    validate_arrays(vertices, triangles);
    Domain domain;
    CanonicalForm form =
        canonical_form(require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows())), vertices);
    domain.surface = std::move(form.surface);
    domain.vertices = std::move(form.vertices);
    domain.original = std::move(form.original_vertices);
    domain.original_faces = std::move(form.original_faces);
    domain.first_corners = std::move(form.first_corners);
    domain.thinnest = form.thinnest;

    const std::size_t outer = choose_outer_loop(domain, options);
    domain.outer_rank = rank_by_lowest_vertex(domain, domain.surface.loops[outer]);
    std::vector<std::size_t> order(domain.surface.loops.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> length;
    for (const VertexLoop& loop : domain.surface.loops) length.push_back(loop_edges(domain.vertices, loop).sum());
    length[outer] = std::numeric_limits<double>::infinity();
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
    for (const std::size_t k : order) {
        domain.loops.push_back(domain.surface.loops[k]);
        domain.edges.push_back(loop_edges(domain.vertices, domain.loops.back()));
    }
    return domain;
}

int rank_by_lowest_vertex(const Domain& domain, const VertexLoop& loop)
{
    const auto lowest = [&](const VertexLoop& l) {
        Index least = domain.original[l.front()];
        for (const Index v : l) least = std::min(least, domain.original[v]);
        return least;
    };
    const Index own = lowest(loop);
    return static_cast<int>(std::count_if(domain.surface.loops.begin(), domain.surface.loops.end(),
                                          [&](const VertexLoop& l) { return lowest(l) < own; }));
}

bool is_polygon(const Domain& domain)
{
    return domain.loops.size() == 1 && domain.surface.vertex_count == static_cast<Index>(domain.loops[0].size());
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
