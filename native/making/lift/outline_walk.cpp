#include "lift/outline_walk.h"

#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace koebe {
namespace {

constexpr double of_segment = 0.05, of_edge = 0.1;  // dimensionless: how near an outline is led through a vertex

/// A face around a node, and what to add to the outline's points for places in its chart.
struct Chart {
    Index face;
    Complex offset;
};

class Walk {
public:
    Walk(const FlatSheet& sheet, const DrawnOutline& outline, std::vector<OutlineNode>& nodes)
        : sheet_(sheet), outline_(outline), nodes_(nodes), chart_{outline.face, 0.0}
    {
        const std::size_t n = outline.points.size();
        double length = 0.0;
        for (std::size_t i = 0; i < n; ++i) length += distance(outline.points[i], outline.points[(i + 1) % n]);
        grain_ = of_segment * length / static_cast<double>(n);
    }

    OutlinePath run()
    {
        path_.end = WalkEnd::closed;
        if (outline_.face < 0) return ended(WalkEnd::border);
        const std::optional<Index> first = place(chart_.face, outline_.points[0]);
        if (!first || !step_to(*first, -1)) return ended(WalkEnd::border);
        const std::size_t n = outline_.points.size();
        for (std::size_t i = 1; i <= n; ++i) {
            closing_ = i == n;
            const WalkEnd end = go_to(outline_.points[i % n]);
            if (end != WalkEnd::closed) return ended(end);
        }
        return tidy() ? path_ : ended(WalkEnd::too_fine);
    }

private:
    OutlinePath ended(WalkEnd end) const { return {end, {}}; }
    Index current() const { return path_.steps.back().node; }
    Complex corner(Index face, int k) const { return sheet_.corner(face, k % 3); }

    WalkEnd go_to(Complex target)
    {
        const std::size_t most = 1000 + std::min<std::size_t>(sheet_.triangles.rows(), 20000);  // faces in one segment
        for (std::size_t count = 0; count < most; ++count) {
            const std::vector<Chart> charts = charts_around(nodes_[current()]);
            if (charts.empty()) return WalkEnd::border;
            for (const Chart& chart : charts)
                if (holds(chart.face, target + chart.offset)) return arrive(chart, target + chart.offset);
            if (const WalkEnd end = leave(charts, target); end != WalkEnd::closed) return end;
        }
        return WalkEnd::too_fine;
    }

    /// The faces that hold a node; none at a border. The first is the present one, if it holds the node.
    std::vector<Chart> charts_around(const OutlineNode& node) const
    {
        if (node.vertex >= 0) return fan(node.vertex);
        if (node.halfedge < 0) return {chart_};
        const Index h = face_of(node.halfedge) == chart_.face ? node.halfedge : sheet_.twin[node.halfedge];
        return {chart_, {face_of(sheet_.twin[h]), chart_.offset + sheet_.step[h]}};
    }

    std::vector<Chart> fan(Index vertex) const
    {
        std::vector<Chart> charts;
        Index h = 3 * chart_.face;
        while (origin(sheet_.triangles, h) != vertex) ++h;
        const Index begin = h;
        Complex offset = chart_.offset;
        do {
            charts.push_back({face_of(h), offset});
            if (sheet_.border[h]) return {};
            offset += sheet_.step[h];
            h = next_halfedge(sheet_.twin[h]);
        } while (h != begin);
        return charts;
    }

    double least_altitude(Index face) const
    {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) longest = std::max(longest, distance(corner(face, k), corner(face, k + 1)));
        return sheet_.twice_area(face) / longest;
    }

    /// Whether a face holds a place, up to a small part of what is led to its edges anyway.
    bool holds(Index face, Complex place) const
    {
        const double room = 1e-3 * std::min(grain_, of_edge * least_altitude(face));
        for (int k = 0; k < 3; ++k) {
            const Complex a = corner(face, k), edge = corner(face, k + 1) - a;
            if (cross(edge, place - a) < -room * std::abs(edge)) return false;
        }
        return true;
    }

    Index add(OutlineNode node)
    {
        nodes_.push_back(node);
        return static_cast<Index>(nodes_.size()) - 1;
    }

    Index at_vertex(Index vertex) { return add({.vertex = vertex}); }

    /// A node on edge k of a face, at a share of it from corner k; led to the edge's ends and to the path's last node.
    std::optional<Index> on_edge(Index face, int k, double share)
    {
        const Index h = 3 * face + k;
        const double length = distance(corner(face, k), corner(face, k + 1));
        const double near = std::min(grain_, of_edge * length) / length;
        if (share < near) return at_vertex(sheet_.triangles(face, k));
        if (share > 1.0 - near) return at_vertex(sheet_.triangles(face, (k + 1) % 3));
        if (sheet_.border[h]) return {};
        const bool own = h < sheet_.twin[h];
        OutlineNode node{.halfedge = own ? h : sheet_.twin[h], .share = own ? share : 1.0 - share};
        if (const Index same = same_place(node, near); same >= 0) return same;
        const Complex a = sheet_.uv[node.halfedge], b = sheet_.uv[next_halfedge(node.halfedge)];
        node.uv = on_grid(a + node.share * (b - a));
        return add(node);
    }

    /// The path's last node, or its first when it closes, if it is that near on the same edge.
    Index same_place(const OutlineNode& node, double near) const
    {
        if (path_.steps.empty()) return -1;
        const Index last = path_.steps.back().node, first = path_.steps.front().node;
        for (const Index other : {last, closing_ ? first : last})
            if (nodes_[other].halfedge == node.halfedge && std::abs(nodes_[other].share - node.share) < near)
                return other;
        return -1;
    }

    Complex on_grid(Complex z) const
    {
        if (sheet_.grid == 0.0) return z;
        return {std::round(z.real() / sheet_.grid) * sheet_.grid, std::round(z.imag() / sheet_.grid) * sheet_.grid};
    }

    /// The node for a place that a face holds. @return nothing at a border
    std::optional<Index> place(Index face, Complex z)
    {
        const double near = std::min(grain_, of_edge * least_altitude(face));
        for (int k = 0; k < 3; ++k)
            if (distance(corner(face, k), z) < near) return at_vertex(sheet_.triangles(face, k));
        for (int k = 0; k < 3; ++k) {
            const Complex a = corner(face, k), edge = corner(face, k + 1) - a;
            if (cross(edge, z - a) >= near * std::abs(edge)) continue;
            return on_edge(face, k, std::clamp(dot(edge, z - a) / std::norm(edge), 0.0, 1.0));
        }
        return add({.face = face, .uv = on_grid(z)});
    }

    bool holds_node(Index face, const OutlineNode& node) const
    {
        if (node.vertex >= 0) return (sheet_.triangles.row(face).array() == node.vertex).any();
        if (node.halfedge >= 0) return face_of(node.halfedge) == face || face_of(sheet_.twin[node.halfedge]) == face;
        return node.face == face;
    }

    WalkEnd arrive(const Chart& chart, Complex place_there)
    {
        chart_ = chart;
        const Index first = path_.steps.front().node;
        if (closing_ && holds_node(chart.face, nodes_[first]) &&
            distance(node_place(sheet_, nodes_[first], chart.face), place_there) < 2.0 * grain_)
            return step_to(first, chart.face) ? WalkEnd::closed : WalkEnd::border;
        const std::optional<Index> node = place(chart.face, place_there);
        return node && step_to(*node, chart.face) ? WalkEnd::closed : WalkEnd::border;
    }

    /// How far the direction from a node to a target leads into a face: a sine, positive inside.
    double into(const OutlineNode& node, Index face, Complex target) const
    {
        const Complex a = node_place(sheet_, node, face);
        const auto side = [&](Complex along) { return cross(along, target - a) / std::abs(along); };
        if (node.vertex >= 0) {
            int k = 0;
            while (sheet_.triangles(face, k) != node.vertex) ++k;
            return std::min(side(corner(face, k + 1) - a), -side(corner(face, k + 2) - a));
        }
        if (node.halfedge < 0) return 0.0;
        const int k = edge_in(face, node);
        return side(corner(face, k + 1) - corner(face, k));
    }

    int edge_in(Index face, const OutlineNode& node) const
    {
        return (face_of(node.halfedge) == face ? node.halfedge : sheet_.twin[node.halfedge]) % 3;
    }

    /// The edge of a face through which the way from a node to a target outside leaves it.
    int exit(const OutlineNode& node, Index face, Complex a, Complex target) const
    {
        const auto left_of = [&](int k) { return cross(corner(face, k) - a, target - a) > 0.0; };
        if (node.vertex >= 0) {
            int k = 0;
            while (sheet_.triangles(face, k) != node.vertex) ++k;
            return (k + 1) % 3;
        }
        if (node.halfedge >= 0) {
            const int k = edge_in(face, node);
            return left_of(k + 2) ? (k + 2) % 3 : (k + 1) % 3;
        }
        for (int k = 0; k < 3; ++k)
            if (left_of(k) && !left_of(k + 1)) return k;
        return 0;
    }

    WalkEnd leave(const std::vector<Chart>& charts, Complex target)
    {
        const OutlineNode node = nodes_[current()];
        const Chart& chart = *std::ranges::max_element(
            charts, {}, [&](const Chart& c) { return into(node, c.face, target + c.offset); });
        chart_ = chart;
        const Complex a = node_place(sheet_, node, chart.face), way = target + chart.offset - a;
        const int k = exit(node, chart.face, a, target + chart.offset);
        const Complex from = corner(chart.face, k), edge = corner(chart.face, k + 1) - from;
        const double share = cross(a - from, way) / cross(edge, way);
        if (!(std::isfinite(share))) return WalkEnd::too_fine;
        const std::optional<Index> next = on_edge(chart.face, k, std::clamp(share, 0.0, 1.0));
        return next && step_to(*next, chart.face) ? WalkEnd::closed : WalkEnd::border;
    }

    bool are_same_vertex(Index a, Index b) const
    {
        return a == b || (nodes_[a].vertex >= 0 && nodes_[a].vertex == nodes_[b].vertex);
    }

    /// Goes on to a node. @return false at a border
    bool step_to(Index node, Index face)
    {
        if (nodes_[node].vertex >= 0 && fan(nodes_[node].vertex).empty()) return false;
        if (!path_.steps.empty() && are_same_vertex(node, current())) return true;
        path_.steps.push_back({node, face});
        return true;
    }

    /// Closes the path, takes out ways there and back, and tells whether a polygon is left that meets no node twice.
    bool tidy()
    {
        std::vector<OutlineStep>& steps = path_.steps;
        if (steps.size() > 1 && are_same_vertex(steps.front().node, steps.back().node)) {
            steps.front().face = steps.back().face;
            steps.pop_back();
        }
        for (std::size_t i = 0; i < steps.size() && steps.size() > 2;) {
            const std::size_t n = steps.size();
            if (!are_same_vertex(steps[i].node, steps[(i + 2) % n].node)) {
                ++i;
                continue;
            }
            const std::size_t second = (i + 1) % n, third = (i + 2) % n;
            if (third < i) {  // keep the step whose chord comes from before
                steps[third].face = steps[i].face;
                steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(std::max(i, second)));
                steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(std::min(i, second)));
            } else {
                steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(third));
                steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(second));
            }
            i = i < 2 ? 0 : i - 2;
        }
        if (steps.size() < 3) return false;
        std::vector<std::array<Index, 2>> keys;
        for (const OutlineStep& step : steps) {
            const Index vertex = nodes_[step.node].vertex;
            keys.push_back({vertex >= 0 ? vertex : -1, vertex >= 0 ? 0 : step.node});
        }
        std::ranges::sort(keys);
        return std::ranges::adjacent_find(keys) == keys.end();
    }

    const FlatSheet& sheet_;
    const DrawnOutline& outline_;
    std::vector<OutlineNode>& nodes_;
    Chart chart_;
    OutlinePath path_;
    double grain_ = 0.0;
    bool closing_ = false;
};

}  // namespace

OutlinePath walk_outline(const FlatSheet& sheet, const DrawnOutline& outline, std::vector<OutlineNode>& nodes)
{
    return Walk(sheet, outline, nodes).run();
}

Complex node_place(const FlatSheet& sheet, const OutlineNode& node, Index face)
{
    if (node.vertex >= 0) {
        int k = 0;
        while (sheet.triangles(face, k) != node.vertex) ++k;
        return sheet.corner(face, k);
    }
    if (node.halfedge >= 0 && face_of(node.halfedge) != face) {
        if (!sheet.border[node.halfedge]) return node.uv + sheet.step[node.halfedge];
        const Complex a = sheet.uv[sheet.twin[node.halfedge]];  // the sheet is cut here, and a chart is not
        return a + (1.0 - node.share) * (sheet.uv[next_halfedge(sheet.twin[node.halfedge])] - a);
    }
    return node.uv;
}

}  // namespace koebe
