#include "planar/planar_region.h"

#include "core/errors.h"

#include <utility>

namespace koebe::detail {

PlanarRegion::PlanarRegion(const std::vector<VectorXcd>& polygons, const std::vector<Complex>& interior)
{
    std::vector<std::pair<Cdt::Point, Index>> points;
    for (const VectorXcd& polygon : polygons)
        for (const Complex z : polygon) points.emplace_back(to_point(z), static_cast<Index>(points.size()));
    const std::size_t boundary_count = points.size();
    for (const Complex z : interior) points.emplace_back(to_point(z), static_cast<Index>(points.size()));
    cdt_.insert(points.begin(), points.end());
    std::vector<Cdt::Vertex_handle> handles(points.size());
    for (auto v = cdt_.finite_vertices_begin(); v != cdt_.finite_vertices_end(); ++v) handles[v->info()] = v;

    std::vector<Index> lost;
    for (std::size_t i = 0; i < boundary_count; ++i)
        if (handles[i] == Cdt::Vertex_handle()) lost.push_back(static_cast<Index>(i));
    if (!lost.empty()) throw InputError("points of a polygon coincide (points listed)", ElementKind::points, lost);
    constrain(polygons, handles);
    mark_inside();
}

void PlanarRegion::constrain(const std::vector<VectorXcd>& polygons, const std::vector<Cdt::Vertex_handle>& handles)
{
    Index begin = 0;
    for (const VectorXcd& polygon : polygons) {
        const Index n = static_cast<Index>(polygon.size());
        for (Index i = 0; i < n; ++i) {
            const Index from = begin + i, to = begin + (i + 1) % n;
            try {
                cdt_.insert_constraint(handles[from], handles[to]);
            } catch (const Cdt::Intersection_of_constraints_exception&) {
                throw InputError("polygons cross (end points of the edge listed)", ElementKind::points, {from, to});
            }
            Cdt::Face_handle face;
            int opposite = 0;
            if (!cdt_.is_edge(handles[from], handles[to], face, opposite))
                throw InputError("a polygon's point lies on an edge (end points of the edge listed)",
                                 ElementKind::points, {from, to});
        }
        begin += n;
    }
}

void PlanarRegion::mark_inside()
{
    constexpr char unknown = -1;
    for (auto f = cdt_.all_faces_begin(); f != cdt_.all_faces_end(); ++f) f->info() = unknown;
    std::vector<Cdt::Face_handle> front{cdt_.infinite_face()}, beyond;
    for (char side = 0; !front.empty(); side ^= 1) {
        beyond.clear();
        for (const Cdt::Face_handle face : front)
            if (face->info() == unknown) face->info() = side;
        while (!front.empty()) {
            const Cdt::Face_handle face = front.back();
            front.pop_back();
            if (face->info() != side) continue;
            for (int i = 0; i < 3; ++i) {
                const Cdt::Face_handle neighbor = face->neighbor(i);
                if (neighbor->info() != unknown) continue;
                if (face->is_constrained(i)) {
                    beyond.push_back(neighbor);
                } else {
                    neighbor->info() = side;
                    front.push_back(neighbor);
                }
            }
        }
        front.swap(beyond);
    }
}

}  // namespace koebe::detail
