#include "splitting/halving.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "core/numbering.h"
#include "cut/edge_graph.h"
#include "splitting/dual_cut.h"

#include <algorithm>
#include <limits>

namespace koebe {
namespace {

constexpr double least_half = 0.35;  // of the area

/// Lengths of paths along edges; -1 without a path.
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

EdgeGraph edge_graph(const PartMesh& part)
{
    const Triangles& triangles = part.surface.triangles;
    SeamedMesh mesh;
    mesh.twin = part.surface.twin;
    mesh.whole.assign(mesh.twin.size(), 0);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        mesh.length.push_back(
            length_of(part.vertices.row(origin(triangles, h)) - part.vertices.row(target(triangles, h))));
    mesh.fans = triangles;
    mesh.fan_count = static_cast<Index>(part.vertices.rows());
    return {mesh, 1.0};
}

}  // namespace

std::vector<int> halving(const PartMesh& part)
{
    const EdgeGraph graph = edge_graph(part);
    const Index first = farthest(distances(graph, part.surface.triangles(0, 0)));
    const std::vector<double> from_first = distances(graph, first);
    const std::vector<double> from_last = distances(graph, farthest(from_first));

    const std::size_t count = part.faces.size();
    std::vector<double> place(count, 0.0);
    std::vector<Index> order = numbers_below(count);
    for (const Index f : order)
        for (const Index v : part.surface.triangles.row(f)) place[f] += from_first[v] - from_last[v];
    std::ranges::stable_sort(order, {}, [&](Index f) { return place[f]; });

    std::vector<Side> sides(count, Side::free);
    double passed = 0.0;
    for (const Index f : order) {
        if (passed < least_half * part.area) sides[f] = Side::inside;
        passed += part.areas[f];
        if (passed > (1.0 - least_half) * part.area) sides[f] = Side::outside;
    }
    return minimum_cut(part, sides);
}

}  // namespace koebe
