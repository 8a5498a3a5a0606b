#include "pipeline/map_input.h"

#include "canonical/canonical_form.h"
#include "canonical/canonical_position.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/vertex_weights.h"
#include "mesh/loop_with.h"
#include "surface/importance.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <limits>
#include <string>

namespace koebe {
namespace {

InputError no_place_for(Index vertex, const std::string& place, const std::string& reason)
{
    return InputError("vertex " + std::to_string(vertex) + " cannot go to " + place + ": " + reason,
                      ElementKind::vertices, {vertex});
}

/// The number of the loop that the options name, in the surface's own order.
std::size_t choose_outer_loop(const MapInput& input, const UniformizeOptions& options)
{
    const auto& loops = input.surface.loops;
    if (options.point >= 0) {
        const std::size_t own = loop_with_original(loops, input.original, options.point);
        const auto length = [&](std::size_t k) { return loop_edges(input.vertices, loops[k]).sum(); };
        for (std::size_t k = 0; k < loops.size(); ++k)
            if (options.outer == OuterLoop::longest && length(k) > (1.0 + same_length) * length(own))
                throw no_place_for(options.point, "1", "it does not lie on the longest loop");
        if (options.outer == OuterLoop::vertex &&
            loop_with_original(loops, input.original, options.outer_vertex) != own)
            throw no_place_for(options.point, "1",
                               "it does not lie on the loop of vertex " + std::to_string(options.outer_vertex));
        return own;
    }
    if (options.outer == OuterLoop::vertex) return loop_with_original(loops, input.original, options.outer_vertex);
    std::size_t longest = 0;
    double length = 0.0;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (const double l = loop_edges(input.vertices, loops[k]).sum(); l > (1.0 + same_length) * length) {
            length = l;
            longest = k;
        }
    return longest;
}

/// The surface's number of the vertex that is to go to 0.
Index find_center(const MapInput& input, const UniformizeOptions& options, Index vertex_count)
{
    if (options.center < 0) return -1;
    if (options.balance != Balance::none)
        throw InputError("center and balance exclude each other: both choose the centre of the disk");
    if (options.center >= vertex_count) throw no_place_for(options.center, "0", "it does not exist");
    const auto found = std::ranges::find(input.original, options.center);
    if (found == input.original.end()) throw no_place_for(options.center, "0", "it belongs to no face");
    const Index center = static_cast<Index>(found - input.original.begin());
    if (loop_with(input.surface.loops, center) >= 0)
        throw no_place_for(options.center, "0", "it lies on a boundary loop");
    return center;
}

/// The importance of the surface's vertices, the least one 0; empty where all are alike.
VectorXd find_importance(const MapInput& input, const UniformizeOptions& options, Index vertex_count)
{
    require_importance(options, vertex_count);
    if (options.importance.empty()) return {};
    VectorXd own(input.vertices.rows());
    for (Eigen::Index v = 0; v < own.size(); ++v) own[v] = options.importance[input.original[v]];
    const double least = own.minCoeff();
    if (own.maxCoeff() == least) return {};
    return own.array() - least;
}

}  // namespace

void require_importance(const UniformizeOptions& options, Index vertex_count)
{
    if (options.importance.empty()) return;
    require_use_of_importance(options.importance, options.even, options.balance == Balance::area);
    require_weights("an importance", options.importance, vertex_count);
}

MapInput prepare_input(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    validate_arrays(vertices, triangles);
    MapInput input;
    CanonicalForm form =
        canonical_form(require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows())), vertices);
    input.surface = std::move(form.surface);
    input.vertices = std::move(form.vertices);
    input.original = std::move(form.original_vertices);
    input.original_faces = std::move(form.original_faces);
    input.thinnest = form.thinnest;

    // The elements that the options name, in the numbers of the canonical form.
    const std::size_t outer = choose_outer_loop(input, options);
    input.center = find_center(input, options, static_cast<Index>(vertices.rows()));
    input.importance = find_importance(input, options, static_cast<Index>(vertices.rows()));
    if (options.point >= 0)
        input.point = static_cast<Index>(std::ranges::find(input.original, options.point) - input.original.begin());
    input.outer_rank = rank_by_lowest_vertex(input, input.surface.loops[outer]);
    // The order of the iteration: the outer loop, then by falling length.
    std::vector<std::size_t> order = numbers_below<std::size_t>(input.surface.loops.size());
    std::vector<double> length;
    for (const VertexLoop& loop : input.surface.loops) length.push_back(loop_edges(input.vertices, loop).sum());
    length[outer] = std::numeric_limits<double>::infinity();
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
    for (const std::size_t k : order) {
        input.loops.push_back(input.surface.loops[k]);
        input.edges.push_back(loop_edges(input.vertices, input.loops.back()));
    }
    return input;
}

void move_input(MapInput& input, const Vertices& vertices)
{
    CanonicalPosition position = canonical_position(input.surface, vertices(input.original, Eigen::all));
    input.vertices = std::move(position.vertices);
    input.thinnest = position.thinnest;
    for (std::size_t k = 0; k < input.loops.size(); ++k) input.edges[k] = loop_edges(input.vertices, input.loops[k]);
}

int rank_by_lowest_vertex(const MapInput& input, const VertexLoop& loop)
{
    const auto lowest = [&](const VertexLoop& l) {
        Index least = input.original[l.front()];
        for (const Index v : l) least = std::min(least, input.original[v]);
        return least;
    };
    const Index own = lowest(loop);
    return static_cast<int>(std::count_if(input.surface.loops.begin(), input.surface.loops.end(),
                                          [&](const VertexLoop& l) { return lowest(l) < own; }));
}

bool is_polygon(const MapInput& input)
{
    return input.loops.size() == 1 && input.surface.vertex_count == static_cast<Index>(input.loops[0].size());
}

MapInput core_input(const MapInput& whole, EarCut& cut)
{
    MapInput core;
    core.surface = std::move(cut.core);
    core.vertices = whole.vertices(cut.vertices, Eigen::all);
    core.original = values_at(whole.original, cut.vertices);
    if (whole.importance.size() > 0) core.importance = whole.importance(cut.vertices);
    core.loops = cut.loops;
    for (const VertexLoop& loop : core.loops) core.edges.push_back(loop_edges(core.vertices, loop));
    core.outer_rank = whole.outer_rank;
    return core;
}

}  // namespace koebe
