#include "planar/filled_paths.h"

#include "core/silent_cgal.h"
#include "planar/planar_predicates.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <array>
#include <map>
#include <utility>

namespace koebe {
namespace {

struct FillState {
    int windings = 0;
    bool seen = false, inside = false;
    Index area = -1;
};

using FillKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using FillFace = CGAL::Triangulation_face_base_with_info_2<FillState, FillKernel,
                                                           CGAL::Constrained_triangulation_face_base_2<FillKernel>>;
using FillTriangulation = CGAL::Constrained_triangulation_plus_2<CGAL::Constrained_Delaunay_triangulation_2<
    FillKernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<FillKernel>, FillFace>,
    CGAL::Exact_intersections_tag>>;
using FaceHandle = FillTriangulation::Face_handle;
using VertexHandle = FillTriangulation::Vertex_handle;

/// A face and one of its edges, the one opposite its vertex of this number.
using FaceEdge = std::pair<FaceHandle, int>;

class Filling {
public:
    Filling(const std::vector<std::vector<Complex>>& rings, bool even_odd) : even_odd_(even_odd)
    {
        insert(rings);
        if (triangulation_.dimension() < 2) return;
        wind();
        number_areas();
    }

    std::vector<FilledBoundary> boundaries()
    {
        std::vector<FilledBoundary> result;
        std::map<FaceEdge, bool> done;
        for (const FaceEdge& edge : border_)
            if (!done[edge]) result.push_back(boundary_from(edge, done));
        return result;
    }

private:
    using Place = std::pair<double, double>;

    /// Inserts each segment once, with the number of times that it is run through from its lower end.
    void insert(const std::vector<std::vector<Complex>>& rings)
    {
        std::map<std::pair<Place, Place>, int> segments;
        for (const std::vector<Complex>& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Complex z = ring[i], w = ring[(i + 1) % ring.size()];
                const Place a{z.real(), z.imag()}, b{w.real(), w.imag()};
                if (a < b) ++segments[{a, b}];
                if (b < a) --segments[{b, a}];
            }
        std::map<Place, VertexHandle> vertices;
        const auto vertex = [&](const Place& place) {
            const auto [at, added] = vertices.try_emplace(place);
            if (added) at->second = triangulation_.insert({place.first, place.second});
            return at->second;
        };
        for (const auto& [ends, times] : segments) {
            if (times == 0) continue;
            const VertexHandle a = vertex(ends.first), b = vertex(ends.second);
            times_.emplace(triangulation_.insert_constraint(a, b), times);
        }
    }

    /// What the number of windings falls by from a face over one of its edges.
    int fall(const FaceHandle& face, int edge)
    {
        if (!face->is_constrained(edge)) return 0;
        const VertexHandle a = face->vertex(FillTriangulation::ccw(edge));
        const VertexHandle b = face->vertex(FillTriangulation::cw(edge));
        int total = 0;
        for (auto c = triangulation_.contexts_begin(a, b); c != triangulation_.contexts_end(a, b); ++c)
            total += *c->current() == a ? times_.at(c->id()) : -times_.at(c->id());
        return total;
    }

    void wind()
    {
        std::vector<FaceHandle> front{triangulation_.infinite_face()};
        front.front()->info().seen = true;
        while (!front.empty()) {
            const FaceHandle face = front.back();
            front.pop_back();
            const int windings = face->info().windings;
            face->info().inside = even_odd_ ? windings % 2 != 0 : windings != 0;
            for (int edge = 0; edge < 3; ++edge) {
                const FaceHandle next = face->neighbor(edge);
                if (next->info().seen) continue;
                next->info().seen = true;
                next->info().windings = windings - fall(face, edge);
                front.push_back(next);
            }
        }
    }

    void number_areas()
    {
        Index count = 0;
        for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f) {
            for (int edge = 0; edge < 3; ++edge)
                if (f->info().inside && !f->neighbor(edge)->info().inside) border_.emplace_back(f, edge);
            if (f->info().inside && f->info().area < 0) spread(f, count++);
        }
    }

    static void spread(const FaceHandle& first, Index area)
    {
        std::vector<FaceHandle> front{first};
        first->info().area = area;
        while (!front.empty()) {
            const FaceHandle face = front.back();
            front.pop_back();
            for (int edge = 0; edge < 3; ++edge) {
                const FaceHandle next = face->neighbor(edge);
                if (!next->info().inside || next->info().area >= 0) continue;
                next->info().area = area;
                front.push_back(next);
            }
        }
    }

    /// Where the border goes on: round the end of the edge, through faces of the area.
    static FaceEdge next_on_border(FaceEdge edge)
    {
        auto [face, i] = edge;
        i = FillTriangulation::ccw(i);
        while (face->neighbor(i)->info().inside) {
            const FaceHandle next = face->neighbor(i);
            i = FillTriangulation::ccw(next->index(face));
            face = next;
        }
        return {face, i};
    }

    static FilledBoundary boundary_from(const FaceEdge& first, std::map<FaceEdge, bool>& done)
    {
        FilledBoundary boundary;
        boundary.area = first.first->info().area;
        FaceEdge edge = first;
        do {
            done[edge] = true;
            const auto& point = edge.first->vertex(FillTriangulation::ccw(edge.second))->point();
            boundary.points.emplace_back(CGAL::to_double(point.x()), CGAL::to_double(point.y()));
            edge = next_on_border(edge);
        } while (edge != first);
        double twice = 0.0;
        for (std::size_t i = 0; i < boundary.points.size(); ++i)
            twice += cross(boundary.points[i] - boundary.points[0],
                           boundary.points[(i + 1) % boundary.points.size()] - boundary.points[0]);
        boundary.hole = twice < 0.0;
        return boundary;
    }

    bool even_odd_;
    FillTriangulation triangulation_;
    std::map<FillTriangulation::Constraint_id, int> times_;
    std::vector<FaceEdge> border_;
};

}  // namespace

std::vector<FilledBoundary> united_paths(const std::vector<FilledPath>& paths)
{
    const SilentCgal silent;
    std::vector<std::vector<Complex>> rings;
    for (const FilledPath& path : paths)
        for (FilledBoundary& boundary : Filling(path.rings, path.even_odd).boundaries())
            rings.push_back(std::move(boundary.points));
    return Filling(rings, false).boundaries();
}

}  // namespace koebe
