#include "planar/divided_polygon.h"

#include "core/numbering.h"
#include "core/silent_cgal.h"
#include "planar/planar_region.h"

#include <algorithm>
#include <bit>
#include <set>
#include <utility>

namespace koebe {
namespace {

using Cdt = detail::PlanarRegion::Cdt;
using EndPair = std::pair<Index, Index>;

constexpr std::size_t many_points = 1000;  // below it the order given is faster

EndPair ends_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// The order in which points are inserted. Many points one after the other along a long side would each turn as many
/// edges as there are points: so every second one comes last, every fourth one before these, and so on, each such round
/// along rows of cells [biased insertion order: Amenta, Choi, Rote 2003].
std::vector<std::size_t> insertion_order(const std::vector<Complex>& points)
{
    std::vector<std::size_t> order = numbers_below<std::size_t>(points.size());
    if (points.size() < many_points) return order;
    order.clear();
    std::vector<std::vector<std::size_t>> rounds(std::bit_width(points.size()) + 1);
    for (std::size_t i = 0; i < points.size(); ++i)
        rounds[std::min(rounds.size() - 1, static_cast<std::size_t>(std::countr_zero(i)))].push_back(i);
    for (auto round = rounds.rbegin(); round != rounds.rend(); ++round) {
        for (const std::size_t k : detail::to_and_fro(values_at(points, *round))) order.push_back((*round)[k]);
    }
    return order;
}

/// Inserts the points. @return their vertices; none for a point that lies where another one is
std::vector<Cdt::Vertex_handle> insert(Cdt& cdt, const std::vector<Complex>& polygon,
                                       const std::vector<Complex>& interior)
{
    std::vector<Complex> points = polygon;
    points.insert(points.end(), interior.begin(), interior.end());
    std::vector<Cdt::Vertex_handle> handles(points.size());
    Cdt::Face_handle near;
    for (const std::size_t i : insertion_order(points)) {
        const auto count = cdt.number_of_vertices();
        const Cdt::Vertex_handle vertex = cdt.insert(detail::to_point(points[i]), near);
        near = vertex->face();
        if (cdt.number_of_vertices() == count) continue;
        vertex->info() = static_cast<Index>(i);
        handles[i] = vertex;
    }
    return handles;
}

/// Marks the faces that the polygon's sides divide from the infinite face by 1, the others by 0.
void mark_inside(Cdt& cdt, const std::set<EndPair>& sides)
{
    for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info().state = 1;
    std::vector<Cdt::Face_handle> front{cdt.infinite_face()};
    front.front()->info().state = 0;
    while (!front.empty()) {
        const Cdt::Face_handle face = front.back();
        front.pop_back();
        for (int i = 0; i < 3; ++i) {
            const Cdt::Vertex_handle a = face->vertex(Cdt::cw(i)), b = face->vertex(Cdt::ccw(i));
            if (!cdt.is_infinite(a) && !cdt.is_infinite(b) && sides.contains(ends_of(a->info(), b->info()))) continue;
            const Cdt::Face_handle next = face->neighbor(i);
            if (next->info().state == 0) continue;
            next->info().state = 0;
            front.push_back(next);
        }
    }
}

}  // namespace

Triangles divided_polygon(const std::vector<Complex>& polygon, const std::vector<Complex>& interior,
                          const std::vector<std::array<Index, 2>>& segments, std::vector<std::size_t>* faulty)
{
    const SilentCgal silent;
    Cdt cdt;
    const std::vector<Cdt::Vertex_handle> handles = insert(cdt, polygon, interior);
    const auto constrain = [&](Index a, Index b) {
        if (handles[a] == Cdt::Vertex_handle() || handles[b] == Cdt::Vertex_handle()) return false;
        try {
            cdt.insert_constraint(handles[a], handles[b]);
        } catch (const Cdt::Intersection_of_constraints_exception&) {
            return false;
        }
        return true;
    };

    // sides first, so that a segment is at fault where it meets one
    const Index n = static_cast<Index>(polygon.size());
    std::set<EndPair> sides, met;
    for (Index i = 0; i < n; ++i) sides.insert(ends_of(i, (i + 1) % n));
    for (const auto& [a, b] : sides)
        if (!constrain(a, b)) return {};
    std::vector<char> at_fault(segments.size(), 0);
    met = sides;  // each once: CGAL refuses a constraint that it has
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const auto [a, b] = segments[i];
        at_fault[i] = met.insert(ends_of(a, b)).second && !constrain(a, b);
    }
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Cdt::Vertex_handle a = handles[segments[i][0]], b = handles[segments[i][1]], none;
        at_fault[i] = at_fault[i] || a == none || b == none || !cdt.is_edge(a, b);
    }

    bool fails = std::ranges::find(handles, Cdt::Vertex_handle()) != handles.end();
    for (const auto& [a, b] : sides) fails = fails || !cdt.is_edge(handles[a], handles[b]);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        fails = fails || at_fault[i];
        if (at_fault[i] && faulty) faulty->push_back(i);
    }
    if (fails) return {};
    mark_inside(cdt, sides);
    std::vector<Index> corners;
    for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f)
        if (f->info().state == 1)
            for (int i = 0; i < 3; ++i) corners.push_back(f->vertex(i)->info());
    return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
}

}  // namespace koebe
