#include "planar/boundary_crossings.h"

#include "planar/meeting_boxes.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <exception>

namespace koebe {
namespace {

struct LoopEdge {
    Index from, to;
    Index begin;  ///< the vertex at which `from` lies: edges that are too short lie between them
};

using EdgeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, LoopEdge>;

/// Ends CGAL's search.
struct CrossingFound : std::exception {};

/// Calls visit(e, f) for all pairs of loop edges that meet without sharing a vertex. The ends of edges that are too
/// short are one vertex.
template <typename Visit>
void visit_crossings(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest,
                     const Visit& visit)
{
    const auto at = [&](Index v) { return Complex(points(v, 0), points(v, 1)); };
    std::vector<EdgeBox> boxes;
    for (const VertexLoop& loop : loops) {
        const std::size_t count = loop.size();
        const auto is_short = [&](Index a, Index b) { return !(std::abs(at(a) - at(b)) >= shortest); };
        // Begin with an edge behind one that is not too short.
        std::size_t start = 0;
        while (start < count && is_short(loop[(start + count - 1) % count], loop[start])) ++start;
        Index end = loop[start % count];  // of the edge before
        for (std::size_t i = start; i < start + count; ++i) {
            const Index from = loop[i % count], to = loop[(i + 1) % count];
            if (is_short(from, to)) continue;
            const LoopEdge edge{from, to, is_short(from, end) ? end : from};
            const Complex a = at(from), b = at(to);
            double low[2] = {std::min(a.real(), b.real()), std::min(a.imag(), b.imag())};
            double high[2] = {std::max(a.real(), b.real()), std::max(a.imag(), b.imag())};
            boxes.emplace_back(low, high, edge);
            end = to;
        }
    }
    detail::visit_meeting_boxes(boxes, [&](const EdgeBox& first, const EdgeBox& second) {
        const LoopEdge e = first.info(), f = second.info();
        if (e.begin == f.begin || e.begin == f.to || e.to == f.begin || e.to == f.to) return;
        if (segments_meet(at(e.from), at(e.to), at(f.from), at(f.to))) visit(e, f);
    });
}

}  // namespace

std::vector<std::pair<Index, Index>> crossing_boundary_edges(const std::vector<VertexLoop>& loops,
                                                             const PlanarPoints& points, double shortest)
{
    std::vector<std::pair<Index, Index>> crossings;
    visit_crossings(loops, points, shortest,
                    [&](LoopEdge e, LoopEdge f) { crossings.emplace_back(std::minmax(e.from, f.from)); });
    std::sort(crossings.begin(), crossings.end());
    return crossings;
}

bool loops_cross(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest)
{
    try {
        visit_crossings(loops, points, shortest, [](LoopEdge, LoopEdge) { throw CrossingFound(); });
    } catch (const CrossingFound&) {
        return true;
    }
    return false;
}

double enclosed_area(const VertexLoop& loop, const PlanarPoints& points)
{
    const auto at = [&](Index v) { return Complex(points(v, 0), points(v, 1)); };
    double area = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        area += 0.5 * std::imag(std::conj(at(loop[i]) - at(loop[0])) * (at(loop[(i + 1) % loop.size()]) - at(loop[0])));
    return area;
}

std::vector<int> turned_loops(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest)
{
    const auto at = [&](Index v) { return Complex(points(v, 0), points(v, 1)); };
    std::vector<double> areas, least;
    for (const VertexLoop& loop : loops) {
        double length = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i) length += std::abs(at(loop[(i + 1) % loop.size()]) - at(loop[i]));
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
