#include "planar/filled_paths.h"

#include "core/silent_cgal.h"
#include "planar/divided_segments.h"
#include "planar/planar_predicates.h"
#include "planar/planar_region.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace koebe {
namespace {

struct FillState {
    int windings = 0;
    std::array<int, 3> fall{};  // what the number of windings falls by over each edge
    std::array<bool, 3> done{};
    bool seen = false, inside = false;
    Index area = -1;
};

using FillKernel = detail::PlanarRegion::Kernel;
using FillFace = CGAL::Triangulation_face_base_with_info_2<FillState, FillKernel,
                                                           CGAL::Constrained_triangulation_face_base_2<FillKernel>>;
using FillTriangulation = CGAL::Constrained_Delaunay_triangulation_2<
    FillKernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<FillKernel>, FillFace>,
    CGAL::No_constraint_intersection_tag>;
using FaceHandle = FillTriangulation::Face_handle;
using VertexHandle = FillTriangulation::Vertex_handle;

/// A face and one of its edges, the one opposite its vertex of this number.
using FaceEdge = std::pair<FaceHandle, int>;

/// By which numbers of windings a point is inside.
enum FillRule : int {
    odd = 0,
    nonzero = 1  ///< at least so many, either way round; n: inside n areas, given by their boundaries
};

class Filling {
public:
    Filling(const std::vector<std::vector<Complex>>& rings, int rule) : rule_(rule)
    {
        std::vector<CountedSegment> segments;
        for (const std::vector<Complex>& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) segments.push_back({ring[i], ring[(i + 1) % ring.size()], 1});
        segments = divided_segments(std::move(segments));
        insert(segments);
        if (triangulation_.dimension() < 2) return;
        wind();
        number_areas();
    }

    std::vector<FilledBoundary> boundaries()
    {
        std::vector<FilledBoundary> result;
        for (const FaceEdge& edge : border_)
            if (!edge.first->info().done[edge.second]) result.push_back(boundary_from(edge));
        return result;
    }

private:
    void insert(const std::vector<CountedSegment>& segments)
    {
        // the ends, numbered along x; each is inserted once, near the one before
        std::vector<Complex> places;
        for (const CountedSegment& one : segments) places.insert(places.end(), {one.lower, one.upper});
        const auto key = [](Complex z) { return std::pair(z.real(), z.imag()); };
        std::ranges::sort(places, {}, key);
        places.erase(std::unique(places.begin(), places.end()), places.end());
        std::vector<VertexHandle> vertices(places.size());
        FaceHandle near;
        for (const std::size_t i : detail::to_and_fro(places)) {
            vertices[i] = triangulation_.insert(detail::to_point(places[i]), near);
            near = vertices[i]->face();
        }
        const auto vertex = [&](Complex z) {
            return vertices[static_cast<std::size_t>(std::ranges::lower_bound(places, key(z), {}, key) -
                                                     places.begin())];
        };
        for (const CountedSegment& one : segments)
            triangulation_.insert_constraint(vertex(one.lower), vertex(one.upper));
        if (triangulation_.dimension() < 2) return;

        // each edge gets its windings once no edge is flipped any more
        for (const CountedSegment& one : segments) {
            FaceHandle face;
            int edge = 0;
            if (!triangulation_.is_edge(vertex(one.lower), vertex(one.upper), face, edge))
                throw std::logic_error("a divided segment is no edge");
            const bool ahead = face->vertex(FillTriangulation::ccw(edge)) == vertex(one.lower);
            const FaceEdge twin = triangulation_.mirror_edge({face, edge});
            face->info().fall[edge] = ahead ? one.times : -one.times;
            twin.first->info().fall[twin.second] = -face->info().fall[edge];
        }
    }

    void wind()
    {
        std::vector<FaceHandle> front{triangulation_.infinite_face()};
        front.front()->info().seen = true;
        while (!front.empty()) {
            const FaceHandle face = front.back();
            front.pop_back();
            const int windings = face->info().windings;
            face->info().inside = rule_ == odd ? windings % 2 != 0 : std::abs(windings) >= rule_;
            for (int edge = 0; edge < 3; ++edge) {
                const FaceHandle next = face->neighbor(edge);
                if (next->info().seen) continue;
                next->info().seen = true;
                next->info().windings = windings - face->info().fall[edge];
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

    static FilledBoundary boundary_from(const FaceEdge& first)
    {
        FilledBoundary boundary;
        boundary.area = first.first->info().area;
        FaceEdge edge = first;
        do {
            edge.first->info().done[edge.second] = true;
            boundary.points.push_back(
                detail::to_complex(edge.first->vertex(FillTriangulation::ccw(edge.second))->point()));
            edge = next_on_border(edge);
        } while (edge != first);
        double twice = 0.0;
        for (std::size_t i = 0; i < boundary.points.size(); ++i)
            twice += cross(boundary.points[i] - boundary.points[0],
                           boundary.points[(i + 1) % boundary.points.size()] - boundary.points[0]);
        boundary.hole = twice < 0.0;
        return boundary;
    }

    int rule_;
    FillTriangulation triangulation_;
    std::vector<FaceEdge> border_;
};

using Rings = std::vector<std::vector<Complex>>;

/// Adds the boundaries of what rings fill.
void append_filled(const Rings& rings, int rule, Rings& to)
{
    for (FilledBoundary& boundary : Filling(rings, rule).boundaries()) to.push_back(std::move(boundary.points));
}

/// What clips leave of paths.
class ClippedPaths {
public:
    explicit ClippedPaths(const std::vector<std::vector<FilledPath>>& clips) : clips_(clips), known_(clips.size()) {}

    /// Boundaries of areas that may overlap each other. Paths with the same clips are united first.
    Rings areas(const std::vector<FilledPath>& paths)
    {
        std::map<std::vector<Index>, Rings> alike;
        for (const FilledPath& path : paths)
            append_filled(path.rings, path.even_odd ? odd : nonzero, alike[path.clips]);
        Rings all;
        for (auto& [clips, rings] : alike) {
            if (!clips.empty()) {  // one arrangement of the areas and the clips: inside is inside all
                Rings both;
                append_filled(rings, nonzero, both);
                for (const Index clip : clips) {
                    const Rings& other = clip_area(clip);
                    both.insert(both.end(), other.begin(), other.end());
                }
                rings.clear();
                append_filled(both, static_cast<int>(clips.size()) + 1, rings);
            }
            std::ranges::move(rings, std::back_inserter(all));
        }
        return all;
    }

private:
    const Rings& clip_area(Index clip)
    {
        std::optional<Rings>& known = known_[static_cast<std::size_t>(clip)];
        if (!known) {
            Rings area;
            append_filled(areas(clips_[static_cast<std::size_t>(clip)]), nonzero, area);
            known = std::move(area);
        }
        return *known;
    }

    const std::vector<std::vector<FilledPath>>& clips_;
    std::vector<std::optional<Rings>> known_;
};

}  // namespace

std::vector<FilledBoundary> united_paths(const std::vector<FilledPath>& paths,
                                         const std::vector<std::vector<FilledPath>>& clips)
{
    const SilentCgal silent;
    if (paths.size() == 1 && paths.front().clips.empty())
        return Filling(paths.front().rings, paths.front().even_odd ? odd : nonzero).boundaries();
    return Filling(ClippedPaths(clips).areas(paths), nonzero).boundaries();
}

}  // namespace koebe
