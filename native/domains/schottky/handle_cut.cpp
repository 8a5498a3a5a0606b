#include "schottky/handle_cut.h"

#include "core/all_elements.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "cut/open_surface.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <map>
#include <utility>

namespace koebe {
namespace {

/// Steps along loops, by the names of their ends. The value is the loop, and the first end's place in it.
using LoopSteps = std::map<std::pair<Index, Index>, std::pair<std::size_t, Index>>;

/// Finds the loop on the other side, if there is one: it has the same steps in reverse.
void find_other_side(const HandleCut& cut, std::size_t own, const LoopSteps& steps, CutLoop& loop)
{
    const auto n = static_cast<Index>(loop.vertices.size());
    const auto name = [&](Index i) { return cut.original[loop.vertices[i % n]]; };
    const auto first = steps.find({name(1), name(0)});
    if (first == steps.end() || first->second.first == own) return;
    const std::size_t other = first->second.first;
    std::vector<Index> matches(n);
    for (Index i = 0; i < n; ++i) {
        const auto step = steps.find({name(i + 1), name(i)});
        if (step == steps.end() || step->second.first != other) return;
        matches[(i + 1) % n] = step->second.second;
    }
    loop.partner = static_cast<int>(other);
    loop.matches = std::move(matches);
}

/// The order of loops: holes by falling length, then pairs as numbered, or by falling length.
std::vector<std::size_t> order_of(const std::vector<CutLoop>& loops, const std::vector<std::array<int, 2>>& handle_of)
{
    std::vector<std::size_t> order = numbers_below<std::size_t>(loops.size());
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        const bool hole = loops[a].partner < 0, other_hole = loops[b].partner < 0;
        if (hole != other_hole) return hole;
        if (!hole && !handle_of.empty())
            return handle_of[loops[a].vertices.front()] < handle_of[loops[b].vertices.front()];
        return loops[a].edges.sum() > loops[b].edges.sum();
    });
    std::vector<char> placed(loops.size(), 0);
    std::vector<std::size_t> result;
    for (const std::size_t k : order) {
        if (std::exchange(placed[k], 1)) continue;
        result.push_back(k);
        if (loops[k].partner < 0) continue;
        result.push_back(static_cast<std::size_t>(loops[k].partner));
        placed[result.back()] = 1;
    }
    return result;
}

[[noreturn]] void throw_too_near(const OpenedSurface& opened, Index vertex_count)
{
    std::vector<Index> elements;
    for (const SurfaceCut& cut : opened.cuts)
        for (const Index v : cut.vertices)
            if (v < vertex_count) elements.push_back(v);
    sort_unique(elements);
    throw TopologyError(TopologyKind::genus,
                        "the handles cannot be cut along edges without touching each other or a hole: subdivide there",
                        elements);
}

}  // namespace

Vertices in_unit_cube(const Vertices& vertices)
{
    const Eigen::RowVector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
    const double extent = 0.5 * (0.5 * high - 0.5 * low).maxCoeff() * 2.0;
    if (!(extent > 0.0))
        throw InputError("all vertices lie on one point", ElementKind::vertices, all_elements(vertices.rows()));
    return (vertices.rowwise() - (0.5 * low + 0.5 * high)) / extent;
}

bool take_loops(HandleCut& cut, const Triangles& triangles, const std::vector<std::array<int, 2>>& handle_of)
{
    cut.surface = require_bordered_genus_zero(triangles, static_cast<Index>(cut.vertices.rows()));
    // Each cut has two sides, with the same vertices of the input in opposite directions.
    LoopSteps steps;
    std::vector<CutLoop> loops;
    for (std::size_t k = 0; k < cut.surface.loops.size(); ++k) {
        CutLoop& loop = loops.emplace_back();
        loop.vertices = cut.surface.loops[k];
        loop.edges = loop_edges(cut.vertices, loop.vertices);
        const auto n = static_cast<Index>(loop.vertices.size());
        for (Index i = 0; i < n; ++i)
            steps[{cut.original[loop.vertices[i]], cut.original[loop.vertices[(i + 1) % n]]}] = {k, i};
    }
    for (std::size_t k = 0; k < loops.size(); ++k) find_other_side(cut, k, steps, loops[k]);
    // Every vertex of a cut lies on two sides, every vertex of a hole on one: the cuts share no vertex.
    std::map<Index, int> met;
    for (const CutLoop& loop : loops)
        for (const Index v : loop.vertices) met[cut.original[v]] += loop.partner < 0 ? 2 : 1;
    if (std::ranges::any_of(met, [](const auto& entry) { return entry.second != 2; })) return false;

    // Holes first, then the two sides of each handle.
    const std::vector<std::size_t> order = order_of(loops, handle_of);
    std::vector<int> number(loops.size());
    for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
    cut.loops.clear();
    cut.holes = 0;
    for (const std::size_t k : order) {
        CutLoop& loop = cut.loops.emplace_back(std::move(loops[k]));
        const int own = static_cast<int>(cut.loops.size()) - 1;
        if (loop.partner < 0) {
            loop.partner = own;
            ++cut.holes;
        } else {
            loop.partner = number[loop.partner];
            loop.handle = (own - static_cast<int>(cut.holes)) / 2;
        }
    }
    return cut.loops.size() == cut.holes + 2 * static_cast<std::size_t>(cut.handles);
}

HandleCut cut_handles(const Vertices& vertices, const Triangles& triangles, Index vertex_count,
                      ExecutionContext& context)
{
    const Surface input = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    OpenOptions options;
    options.long_slit = false;
    options.slit_beside_handles = false;
    const OpenedSurface opened = open_surface(vertices, input.triangles, options, context);
    if (opened.pieces.size() != 1) throw_too_near(opened, vertex_count);
    const SurfacePiece& piece = opened.pieces.front();
    HandleCut cut;
    cut.handles = input.genus;
    cut.original = piece.source_vertex;
    cut.input_face = piece.source_face;
    cut.vertices = in_unit_cube(piece.vertices);
    cut.corners.resize(cut.input_face.size());
    for (std::size_t f = 0; f < cut.input_face.size(); ++f)
        for (int k = 0; k < 3; ++k) cut.corners.at(cut.input_face[f])[k] = 3 * static_cast<Index>(f) + k;
    if (!take_loops(cut, piece.triangles, {})) throw_too_near(opened, vertex_count);
    // A loop without another side, of edges with two faces each, is not a hole: cuts touch there.
    std::map<std::pair<Index, Index>, char> border;
    for (Index h = 0; h < static_cast<Index>(input.triangles.size()); ++h)
        if (input.twin[h] == no_twin) border[{origin(input.triangles, h), target(input.triangles, h)}] = 1;
    for (const CutLoop& loop : cut.loops)
        for (std::size_t i = 0; loop.handle < 0 && i < loop.vertices.size(); ++i)
            if (!border.contains(
                    {cut.original[loop.vertices[i]], cut.original[loop.vertices[(i + 1) % loop.vertices.size()]]}))
                throw_too_near(opened, vertex_count);
    return cut;
}

}  // namespace koebe
