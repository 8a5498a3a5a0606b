#include "packing/island_outline.h"

#include "cost/tolerances.h"
#include "planar/boundary_crossings.h"

#include <algorithm>
#include <numeric>

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

std::pair<Outline, bool> outline_of_faces(const PlanarPoints& points, const std::vector<std::array<Index, 3>>& faces)
{
    bool doubled = false;
    Outline outline{points, walks_round(faces, static_cast<std::size_t>(points.rows()), doubled)};
    outline.along_axes = lies_straight(outline);
    const bool overlaps = doubled || run_over_each_other(outline.loops, points);
    return {std::move(outline), overlaps};
}

}  // namespace koebe
