#include "packing/layer_islands.h"

#include "core/sort_unique.h"
#include "cut/disjoint_sets.h"
#include "packing/island_outline.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace koebe {

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
    std::tie(island.outline, island.overlaps) = outline_of_faces(unit, own);
    island.outline.points = island.points;
    // Faces on a line have no walk where they cancel.
    for (std::size_t f = 0; f < own.size(); ++f)
        if (areas[f] == 0.0) island.outline.loops.emplace_back(own[f].begin(), own[f].end());
    return island;
}

}  // namespace koebe
