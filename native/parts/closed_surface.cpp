#include "parts/closed_surface.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "cut/edge_graph.h"
#include "parts/dual_cut.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace koebe {
namespace {

constexpr double least_half = 0.35;  // of the area

/// The lowest vertex of the piece at each vertex's place in the input.
std::vector<Index> undoubled(const std::vector<Index>& source)
{
    std::vector<Index> order(source.size()), lowest(source.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](Index v) { return source[v]; });
    for (std::size_t i = 0; i < order.size(); ++i)
        lowest[order[i]] = i > 0 && source[order[i]] == source[order[i - 1]] ? lowest[order[i - 1]] : order[i];
    return lowest;
}

/// By path along the edges; no number where no path leads.
std::vector<double> distances(const EdgeGraph& graph, Index from)
{
    std::vector<double> distance = shortest_paths(graph, {from}).distance;
    std::ranges::replace_if(
        distance, [](double d) { return d == std::numeric_limits<double>::max(); }, -1.0);
    return distance;
}

Index farthest(const std::vector<double>& distance)
{
    return static_cast<Index>(std::ranges::max_element(distance) - distance.begin());
}

EdgeGraph edge_graph(const CutSurface& closed)
{
    SeamedMesh mesh;
    mesh.twin = closed.surface.twin;
    mesh.whole.assign(mesh.twin.size(), 0);
    mesh.length.assign(closed.lengths.begin(), closed.lengths.end());
    mesh.fans = closed.surface.triangles;
    mesh.fan_count = static_cast<Index>(closed.vertices.rows());
    return {mesh, 1.0};
}

}  // namespace

std::optional<CutSurface> closed_surface(const SurfacePiece& piece, const Vertices& vertices,
                                         const std::vector<Index>& polygon)
{
    const std::vector<Index> lowest = undoubled(piece.source_vertex);
    Triangles triangles = piece.triangles;
    bool doubled = false;
    for (Eigen::Index i = 0; i < triangles.size(); ++i) {
        Index& v = triangles.data()[i];
        doubled |= lowest[v] != v;
        v = lowest[v];
    }
    if (!doubled) return {};
    try {
        Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
        if (!surface.loops.empty() || surface.genus != 0) return {};
        return cut_surface(vertices, std::move(surface), polygon);
    } catch (const TopologyError&) {  // vertices that were split for another reason
        return {};
    }
}

std::vector<std::vector<Index>> halves(const CutSurface& closed)
{
    const EdgeGraph graph = edge_graph(closed);
    const Index first = farthest(distances(graph, closed.surface.triangles(0, 0)));
    const std::vector<double> from_first = distances(graph, first);
    const std::vector<double> from_last = distances(graph, farthest(from_first));

    const std::size_t count = static_cast<std::size_t>(closed.areas.size());
    std::vector<double> place(count, 0.0);
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (const Index f : order)
        for (const Index v : closed.surface.triangles.row(f)) place[f] += from_first[v] - from_last[v];
    std::ranges::stable_sort(order, {}, [&](Index f) { return place[f]; });

    const PartMesh all = some_or_all(closed, std::vector<Index>(count));
    std::vector<Side> sides(count, Side::free);
    double passed = 0.0;
    const double whole = closed.areas.sum();
    for (const Index f : order) {
        if (passed < least_half * whole) sides[f] = Side::inside;
        passed += closed.areas[f];
        if (passed > (1.0 - least_half) * whole) sides[f] = Side::outside;
    }
    const std::vector<int> label = minimum_cut(all, sides);
    if (label.empty()) return {};
    Index pieces = 0;
    const std::vector<Index> piece = connected_pieces(all, label, pieces);
    std::vector<std::vector<Index>> faces(pieces);
    for (std::size_t f = 0; f < count; ++f) faces[piece[f]].push_back(static_cast<Index>(f));
    return faces;
}

}  // namespace koebe
