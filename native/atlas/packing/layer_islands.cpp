#include "packing/layer_islands.h"

#include "core/sort_unique.h"
#include "cost/tolerances.h"
#include "cut/disjoint_sets.h"
#include "planar/boundary_crossings.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

/// The closed walks round the faces of an island, each face counter-clockwise: their winding number at a point is the
/// number of faces there. Sets whether two faces lie on the same side of an edge. @param count of vertices
std::vector<VertexLoop> walks_round(const std::vector<std::array<Index, 3>>& faces, std::size_t count, bool& doubled)
{
    std::vector<std::pair<Index, Index>> edges, left;
    for (const auto& [a, b, c] : faces)
        if (a != b && b != c && c != a) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
    std::ranges::sort(edges);
    doubled = std::ranges::adjacent_find(edges) != edges.end();
    // Edges that faces have in both directions cancel.
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto same = std::equal_range(edge, edges.end(), *edge);
        const auto back = std::equal_range(edges.begin(), edges.end(), std::pair(edge->second, edge->first));
        left.insert(left.end(), std::max<std::ptrdiff_t>(0, same.second - edge - (back.second - back.first)), *edge);
        edge = same.second;
    }
    // As many edges enter a vertex as leave it: a walk along unused edges ends where it began.
    std::vector<std::size_t> next(count + 1, 0);
    for (const auto& edge : left) ++next[edge.first + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<VertexLoop> walks;
    const std::vector<std::size_t> begin = next;
    for (Index first = 0; first < static_cast<Index>(count); ++first)
        while (next[first] < begin[first + 1]) {
            VertexLoop& walk = walks.emplace_back();
            Index v = first;
            do {
                walk.push_back(v);
                v = left[next[v]++].second;
            } while (v != first);
        }
    return walks;
}

/// How often loops run round a point that is on none of them.
int winding_at(const std::vector<VertexLoop>& loops, const PlanarPoints& points, const Eigen::RowVector2d& at)
{
    int turns = 0;
    for (const VertexLoop& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Eigen::RowVector2d a = points.row(loop[i]) - at, b = points.row(loop[(i + 1) % loop.size()]) - at;
            if ((a[1] > 0.0) == (b[1] > 0.0)) continue;
            if ((a[0] * b[1] - a[1] * b[0] > 0.0) == (b[1] > a[1])) turns += b[1] > a[1] ? 1 : -1;
        }
    return turns;
}

/// Whether loops without doubled edges meet, or run round a part of the plane twice.
bool run_over_each_other(const std::vector<VertexLoop>& loops, const PlanarPoints& points)
{
    if (!crossing_boundary_edges(loops, points, 0.0).empty()) return true;
    std::vector<std::size_t> outer;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (enclosed_area(loops[k], points) > 0.0) outer.push_back(k);
    if (outer.size() < 2) return false;
    return std::ranges::any_of(outer, [&](std::size_t k) {
        std::vector<VertexLoop> others = loops;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        return winding_at(others, points, 0.5 * (points.row(loops[k][0]) + points.row(loops[k][1]))) != 0;
    });
}

/// Whether much of the outline lies along the axes.
bool lies_straight(const Outline& outline)
{
    double all = 0.0, along = 0.0;
    for (const VertexLoop& loop : outline.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto edge = outline.points.row(loop[(i + 1) % loop.size()]) - outline.points.row(loop[i]);
            all += edge.norm();
            if (edge.cwiseAbs().minCoeff() <= tolerance::off_axis * edge.cwiseAbs().maxCoeff()) along += edge.norm();
        }
    return along > tolerance::along_axes * all;
}

}  // namespace

LayerVertices layer_vertices(const Triangles& triangles, const PlanarPoints& uv)
{
    using Corner = std::tuple<Index, double, double, Index>;
    int exponent = 0;
    std::frexp(uv.cwiseAbs().maxCoeff(), &exponent);
    const PlanarPoints points = uv.unaryExpr([&](double x) { return std::ldexp(x, -exponent); });
    std::vector<Corner> corners;
    for (Index c = 0; c < static_cast<Index>(uv.rows()); ++c)
        corners.emplace_back(triangles.data()[c], as_stored(points(c, 0)), as_stored(points(c, 1)), c);
    std::ranges::sort(corners);
    LayerVertices layer{triangles, PlanarPoints(uv.rows(), 2), std::ldexp(1.0, exponent)};
    Index count = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto& [vertex, u, v, c] = corners[i];
        const bool is_new =
            i == 0 || std::tie(vertex, u, v) != std::tie(std::get<0>(corners[i - 1]), std::get<1>(corners[i - 1]),
                                                         std::get<2>(corners[i - 1]));
        if (is_new) layer.points.row(count++) = points.row(c);
        layer.faces.data()[c] = count - 1;
    }
    layer.points.conservativeResize(count, 2);
    return layer;
}

std::vector<Index> islands_of(const LayerVertices& layer, const std::vector<Index>& polygon, Index& count)
{
    const Index vertices = static_cast<Index>(layer.points.rows()), faces = static_cast<Index>(layer.faces.rows());
    const Index polygons = polygon.empty() ? 0 : *std::ranges::max_element(polygon) + 1;
    DisjointSets sets(static_cast<std::size_t>(vertices) + static_cast<std::size_t>(polygons));
    for (Index f = 0; f < faces; ++f) {
        for (int k = 1; k < 3; ++k) sets.join(layer.faces(f, 0), layer.faces(f, k));
        if (!polygon.empty()) sets.join(layer.faces(f, 0), vertices + polygon[f]);
    }
    std::vector<Index> number(static_cast<std::size_t>(vertices + polygons), -1), island;
    count = 0;
    for (Index f = 0; f < faces; ++f) {
        Index& own = number[sets.find(layer.faces(f, 0))];
        if (own < 0) own = count++;
        island.push_back(own);
    }
    return island;
}

PackedPiece island_alone(const LayerVertices& layer, std::vector<Index> faces)
{
    PackedPiece island{std::move(faces), {}, {}};
    for (const Index f : island.faces)
        for (int k = 0; k < 3; ++k) island.vertices.push_back(layer.faces(f, k));
    sort_unique(island.vertices);
    island.points = layer.points(island.vertices, Eigen::all);
    island.points.rowwise() -= island.points.colwise().minCoeff().eval();
    // Areas in the unit of the extent: they neither overflow nor vanish.
    const double extent = std::max(island.points.maxCoeff(), 1e-300);
    const PlanarPoints unit = island.points / extent;
    std::vector<std::array<Index, 3>> own;
    std::vector<double> areas;
    for (const Index f : island.faces) {
        auto& face = own.emplace_back();
        for (int k = 0; k < 3; ++k)
            face[k] = static_cast<Index>(std::ranges::lower_bound(island.vertices, layer.faces(f, k)) -
                                         island.vertices.begin());
        const Eigen::RowVector2d a = unit.row(face[1]) - unit.row(face[0]), b = unit.row(face[2]) - unit.row(face[0]);
        areas.push_back(0.5 * (a[0] * b[1] - a[1] * b[0]));
    }
    island.is_mirrored = std::accumulate(areas.begin(), areas.end(), 0.0) < 0.0;
    for (std::size_t f = 0; f < own.size(); ++f)
        if (areas[f] < 0.0 || (areas[f] == 0.0 && island.is_mirrored)) std::swap(own[f][1], own[f][2]);
    for (const double area : areas) island.area += std::abs(area) * extent * extent;
    bool doubled = false;
    island.outline = {unit, walks_round(own, island.vertices.size(), doubled)};
    island.outline.along_axes = lies_straight(island.outline);
    island.overlaps = doubled || run_over_each_other(island.outline.loops, unit);
    island.outline.points = island.points;
    // Faces on a line have no walk where they cancel.
    for (std::size_t f = 0; f < own.size(); ++f)
        if (areas[f] == 0.0) island.outline.loops.emplace_back(own[f].begin(), own[f].end());
    return island;
}

}  // namespace koebe
