#include "planar/divided_polygon.h"

#include "core/silent_cgal.h"
#include "planar/planar_region.h"

#include <set>
#include <utility>

namespace koebe {
namespace {

using Cdt = detail::PlanarRegion::Cdt;
using EndPair = std::pair<Index, Index>;

EndPair ends_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// Inserts the points. @return their vertices; fewer if two coincide
std::vector<Cdt::Vertex_handle> insert(Cdt& cdt, const std::vector<Complex>& polygon,
                                       const std::vector<Complex>& interior)
{
    std::vector<Cdt::Vertex_handle> handles;
    for (const auto* points : {&polygon, &interior})
        for (const Complex z : *points) {
            const auto count = cdt.number_of_vertices();
            const Cdt::Face_handle near = handles.empty() ? Cdt::Face_handle() : handles.back()->face();
            const Cdt::Vertex_handle vertex = cdt.insert(detail::to_point(z), near);
            if (cdt.number_of_vertices() == count) return {};
            vertex->info() = static_cast<Index>(handles.size());
            handles.push_back(vertex);
        }
    return handles;
}

/// Marks the faces that the polygon's sides divide from the infinite face by 1, the others by 0.
void mark_inside(Cdt& cdt, const std::set<EndPair>& sides)
{
    for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info() = 1;
    std::vector<Cdt::Face_handle> front{cdt.infinite_face()};
    front.front()->info() = 0;
    while (!front.empty()) {
        const Cdt::Face_handle face = front.back();
        front.pop_back();
        for (int i = 0; i < 3; ++i) {
            const Cdt::Vertex_handle a = face->vertex(Cdt::cw(i)), b = face->vertex(Cdt::ccw(i));
            if (!cdt.is_infinite(a) && !cdt.is_infinite(b) && sides.contains(ends_of(a->info(), b->info()))) continue;
            const Cdt::Face_handle next = face->neighbor(i);
            if (next->info() == 0) continue;
            next->info() = 0;
            front.push_back(next);
        }
    }
}

}  // namespace

Triangles divided_polygon(const std::vector<Complex>& polygon, const std::vector<Complex>& interior,
                          const std::vector<std::array<Index, 2>>& segments)
{
    const SilentCgal silent;
    Cdt cdt;
    const std::vector<Cdt::Vertex_handle> handles = insert(cdt, polygon, interior);
    if (handles.size() != polygon.size() + interior.size()) return {};
    const Index n = static_cast<Index>(polygon.size());
    std::set<EndPair> sides;
    for (Index i = 0; i < n; ++i) sides.insert(ends_of(i, (i + 1) % n));
    std::set<EndPair> all = sides;  // each once: CGAL refuses a constraint that it has
    for (const auto& [a, b] : segments) all.insert(ends_of(a, b));
    try {
        for (const auto& [a, b] : all) cdt.insert_constraint(handles[a], handles[b]);
    } catch (const Cdt::Intersection_of_constraints_exception&) {
        return {};
    }
    for (const auto& [a, b] : all)
        if (!cdt.is_edge(handles[a], handles[b])) return {};
    mark_inside(cdt, sides);
    std::vector<Index> corners;
    for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f)
        if (f->info() == 1)
            for (int i = 0; i < 3; ++i) corners.push_back(f->vertex(i)->info());
    return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
}

}  // namespace koebe
