#include "foldover/tangled_map.h"

#include "circles/on_circle.h"
#include "core/sort_unique.h"
#include "core/uv_resolution.h"
#include "execution/thread_share.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr double least_edge = 1e-11;  // disk units: 1e5 times the rounding of 64-bit positions

}  // namespace

TangledMap::TangledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv)
    : vertices_(vertices),
      surface_(surface),
      loops_(loops),
      circles_(circles),
      uv_(uv),
      place_(surface.vertex_count, Place::inside),
      ear_(surface.vertex_count, 0),
      held_(surface.vertex_count, 0),
      loop_of_(surface.vertex_count, -1),
      vertex_faces_(surface.triangles, surface.vertex_count)
{
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Index v : loops[k]) {
            loop_of_[v] = static_cast<int>(k);
            place_[v] = Place::on_circle;
        }
    for (const Index v : off_circle) {
        place_[v] = Place::off_circle;
        ear_[v] = 1;
    }
}

std::vector<Index> TangledMap::tangled() const
{
    return found_in_pieces(static_cast<Index>(triangles().rows()), [&](Index f) {
        const StoredFace face(triangles(), uv_, f);
        return face.doubtful() && !face.below_resolution();
    });
}

std::vector<Index> TangledMap::tangled(const std::vector<Index>& faces) const
{
    std::vector<Index> result;
    for (const Index f : faces)
        if (const StoredFace face(triangles(), uv_, f); face.doubtful() && !face.below_resolution())
            result.push_back(f);
    return result;
}

std::size_t TangledMap::flipped(const std::vector<Index>& faces) const
{
    return std::count_if(faces.begin(), faces.end(),
                         [&](Index f) { return StoredFace(triangles(), uv_, f).doubtful(); });
}

bool TangledMap::collapsed(Index vertex) const
{
    for (const Index f : faces_around(vertex))
        for (const Index v : triangles().row(f))
            if ((uv_.row(v) - uv_.row(vertex)).norm() > least_edge) return false;
    return true;
}

bool TangledMap::mobile(Index vertex, PatchBoundary boundary) const
{
    const bool may = place_[vertex] == Place::inside || boundary == PatchBoundary::sliding ||
                     (place_[vertex] == Place::off_circle && boundary == PatchBoundary::freed);
    return may && !held(vertex) && !collapsed(vertex);
}

bool TangledMap::touches_ear(Index face) const
{
    return std::any_of(triangles().row(face).begin(), triangles().row(face).end(),
                       [&](Index v) { return ear_[v] != 0; });
}

bool TangledMap::near_circle(Index vertex) const
{
    return is_on_circle(circles_[loop_of_[vertex]], {uv_(vertex, 0), uv_(vertex, 1)}, inner_circle_tolerance);
}

bool TangledMap::loops_cross(const std::vector<Index>& moved) const
{
    const auto at = [&](Index v) { return Complex(uv_(v, 0), uv_(v, 1)); };
    for (const VertexLoop& loop : loops_)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index a = loop[i], b = loop[(i + 1) % loop.size()];
            if (!std::binary_search(moved.begin(), moved.end(), a) &&
                !std::binary_search(moved.begin(), moved.end(), b))
                continue;
            for (const VertexLoop& other : loops_)
                for (std::size_t j = 0; j < other.size(); ++j) {
                    const Index c = other[j], d = other[(j + 1) % other.size()];
                    if (c != a && c != b && d != a && d != b && segments_meet(at(a), at(b), at(c), at(d))) return true;
                }
        }
    return false;
}

std::vector<int> TangledMap::clockwise_holes(const std::vector<Index>& moved) const
{
    std::vector<int> loops, result;
    for (const Index v : moved) loops.push_back(loop_of_[v]);
    sort_unique(loops);
    for (const int k : loops)
        if (enclosed_area(loops_[k], uv_) < 0.0) result.push_back(k);
    return result;
}

}  // namespace koebe
