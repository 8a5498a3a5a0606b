#include "planar/boundary_crossings.h"

#include "core/complex_places.h"
#include "planar/meeting_boxes.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <exception>

namespace koebe {
namespace {

constexpr std::size_t most_drawings = 3;

struct LoopEdge {
    Index from, to;
    /// In each drawing the vertex at which `from` lies: edges that are too short lie between them; -1: it is one.
    std::array<Index, most_drawings> begin;
};

using EdgeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, LoopEdge>;

/// Ends CGAL's search.
struct CrossingFound : std::exception {};

/// LoopEdge::begin of all edges of a loop. The ends of edges that are too short are one vertex.
std::vector<Index> begins_of_edges(const VertexLoop& loop, const LoopDrawing& drawing)
{
    const std::size_t count = loop.size();
    const auto is_short = [&](Index a, Index b) {
        return !(std::abs(complex_at(drawing.points, a) - complex_at(drawing.points, b)) >= drawing.shortest);
    };
    // Begin with an edge behind one that is not too short.
    std::size_t start = 0;
    while (start < count && is_short(loop[(start + count - 1) % count], loop[start])) ++start;
    std::vector<Index> begins(count, -1);
    Index end = loop[start % count];  // of the edge before
    for (std::size_t i = start; i < start + count; ++i) {
        const Index from = loop[i % count], to = loop[(i + 1) % count];
        if (is_short(from, to)) continue;
        begins[i % count] = is_short(from, end) ? end : from;
        end = to;
    }
    return begins;
}

bool share_a_vertex(const LoopEdge& e, const LoopEdge& f, std::size_t drawing)
{
    const Index a = e.begin[drawing], b = f.begin[drawing];
    return a == b || a == f.to || e.to == b || e.to == f.to;
}

/// Calls visit(e, f) for all pairs of loop edges that meet in a drawing without sharing a vertex.
/// @param drawings most_drawings at most @param reach how far points of other drawings lie from those of the first,
/// after a common shift
template <typename Visit>
void visit_crossings(const std::vector<VertexLoop>& loops, std::span<const LoopDrawing> drawings, double reach,
                     const Visit& visit)
{
    const PlanarPoints& points = drawings.front().points;
    // The box of each edge in the first drawing, wide enough for the others.
    std::vector<EdgeBox> boxes;
    for (const VertexLoop& loop : loops) {
        std::array<std::vector<Index>, most_drawings> begins;
        for (std::size_t k = 0; k < drawings.size(); ++k) begins[k] = begins_of_edges(loop, drawings[k]);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            LoopEdge edge{loop[i], loop[(i + 1) % loop.size()], {-1, -1, -1}};
            for (std::size_t k = 0; k < drawings.size(); ++k) edge.begin[k] = begins[k][i];
            if (std::ranges::max(edge.begin) < 0) continue;
            const Complex a = complex_at(points, edge.from), b = complex_at(points, edge.to);
            double low[2] = {std::min(a.real(), b.real()) - reach, std::min(a.imag(), b.imag()) - reach};
            double high[2] = {std::max(a.real(), b.real()) + reach, std::max(a.imag(), b.imag()) + reach};
            boxes.emplace_back(low, high, edge);
        }
    }
    // Where boxes meet, each drawing is asked exactly.
    detail::visit_meeting_boxes(boxes, [&](const EdgeBox& first, const EdgeBox& second) {
        const LoopEdge e = first.info(), f = second.info();
        for (std::size_t k = 0; k < drawings.size(); ++k)
            if (const PlanarPoints& own = drawings[k].points;
                e.begin[k] >= 0 && f.begin[k] >= 0 && !share_a_vertex(e, f, k) &&
                segments_meet(complex_at(own, e.from), complex_at(own, e.to), complex_at(own, f.from),
                              complex_at(own, f.to)))
                visit(e, f);
    });
}

}  // namespace

std::vector<std::pair<Index, Index>> crossing_boundary_edges(const std::vector<VertexLoop>& loops,
                                                             const PlanarPoints& points, double shortest)
{
    std::vector<std::pair<Index, Index>> crossings;
    const LoopDrawing drawing{points, shortest};
    visit_crossings(loops, std::span(&drawing, 1), 0.0,
                    [&](LoopEdge e, LoopEdge f) { crossings.emplace_back(std::minmax(e.from, f.from)); });
    std::sort(crossings.begin(), crossings.end());
    return crossings;
}

bool loops_cross(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest)
{
    const LoopDrawing drawing{points, shortest};
    return loops_cross(loops, std::span(&drawing, 1), 0.0);
}

bool loops_cross(const std::vector<VertexLoop>& loops, std::span<const LoopDrawing> drawings, double reach)
{
    try {
        visit_crossings(loops, drawings, reach, [](LoopEdge, LoopEdge) { throw CrossingFound(); });
    } catch (const CrossingFound&) {
        return true;
    }
    return false;
}

double enclosed_area(const VertexLoop& loop, const PlanarPoints& points)
{
    const auto from_first = [&](std::size_t i) {
        return complex_at(points, loop[i % loop.size()]) - complex_at(points, loop[0]);
    };
    double area = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) area += 0.5 * std::imag(std::conj(from_first(i)) * from_first(i + 1));
    return area;
}

std::vector<int> turned_loops(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest)
{
    std::vector<double> areas, least;
    for (const VertexLoop& loop : loops) {
        double length = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i)
            length += std::abs(complex_at(points, loop[(i + 1) % loop.size()]) - complex_at(points, loop[i]));
        areas.push_back(enclosed_area(loop, points));
        least.push_back(shortest * length);
    }
    std::vector<int> turned;
    if (areas.empty()) return turned;
    const double outer = *std::ranges::max_element(areas, {}, [](double area) { return std::abs(area); });
    bool outer_seen = false;  // the outer loop is the first one of its area
    for (std::size_t k = 0; k < areas.size(); ++k)
        if (!outer_seen && areas[k] == outer)
            outer_seen = true;
        else if (std::abs(areas[k]) > least[k] && (areas[k] > 0.0) == (outer > 0.0))
            turned.push_back(static_cast<int>(k));
    return turned;
}

}  // namespace koebe
