#include "io/polygon_triangulation.h"

#include "core/errors.h"
#include "core/silent_cgal.h"
#include "execution/thread_share.h"
#include "planar/divided_polygon.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

namespace koebe {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<Index, 3>;
using Polygon = std::vector<Index>;
using Positions = std::vector<Vector3d>;

/// From so many corners on, CGAL's Delaunay search space beats the cubic method (measured: flat, 16 corners).
constexpr std::size_t delaunay_corners = 17;
/// Largest number of corners for the cubic method, the last resort, which then takes a second.
constexpr std::size_t cubic_corners = 500;
/// Of a polygon's area: a triangle of less has none, or is turned over.
constexpr double least_area = 1e-6;

/// The corners without immediate repetitions.
Polygon distinct_corners(std::span<const Index> face)
{
    Polygon polygon(face.begin(), face.end());
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    return polygon;
}

/// Positions moved to the origin and scaled to a largest coordinate of 1, so that no square over- or underflows.
Positions normalized_positions(const Vertices& vertices, const Polygon& polygon)
{
    Positions positions;
    positions.reserve(polygon.size());
    double scale = 0.0;
    const Vector3d origin = vertices.row(polygon.front()).transpose();
    for (const Index v : polygon) {
        positions.push_back(0.5 * vertices.row(v).transpose() - 0.5 * origin);
        scale = std::max(scale, positions.back().lpNorm<Eigen::Infinity>());
    }
    if (scale > 0.0)
        for (Vector3d& p : positions) p /= scale;
    return positions;
}

/// @returns corner numbers
std::vector<Triangle> cut_quadrilateral(const Positions& p)
{
    const Vector3d diagonal_02 = p[2] - p[0], diagonal_13 = p[3] - p[1];
    const Vector3d normal = diagonal_02.cross(diagonal_13);  // twice the polygon's area vector
    const auto side = [&](int a, int b, int c) { return (p[b] - p[a]).cross(p[c] - p[a]).dot(normal); };
    const double worst_02 = std::min(side(0, 1, 2), side(0, 2, 3));
    const double worst_13 = std::min(side(0, 1, 3), side(1, 2, 3));
    const bool both_fit = std::min(worst_02, worst_13) > least_area * normal.squaredNorm();
    const bool cut_02 = both_fit ? diagonal_02.squaredNorm() <= diagonal_13.squaredNorm() : worst_02 >= worst_13;
    if (cut_02) return {{0, 1, 2}, {0, 2, 3}};
    return {{0, 1, 3}, {1, 2, 3}};
}

/// Whether the polygon goes from one vertex to the same next one twice. No slit does, and CGAL takes seconds to fail.
bool repeats_an_edge(const Polygon& polygon)
{
    std::vector<std::array<Index, 2>> edges;
    edges.reserve(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    std::ranges::sort(edges);
    return std::ranges::adjacent_find(edges) != edges.end();
}

/// @returns corner numbers; fewer than size - 2 triangles if the polygon cannot be cut
std::vector<Triangle> cut_polygon(const Positions& positions)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> points;
    points.reserve(positions.size());
    for (const Vector3d& p : positions) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<CGAL::Triple<int, int, int>> cut;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        points, std::back_inserter(cut),
        CGAL::parameters::use_delaunay_triangulation(positions.size() >= delaunay_corners)
            .do_not_use_cubic_algorithm(positions.size() >= cubic_corners));
    std::vector<Triangle> triangles;
    triangles.reserve(cut.size());
    for (const auto& t : cut) triangles.push_back({t.first, t.second, t.third});
    return triangles;
}

/// The polygon's area vector, twice its length.
Vector3d area_vector(const Positions& p)
{
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i + 1 < p.size(); ++i) sum += (p[i] - p[0]).cross(p[i + 1] - p[0]);
    return sum;
}

/// The least area of triangles over the polygon's, seen along the polygon's area vector; negative: turned over.
double smallest_share(const Positions& p, const std::vector<Triangle>& triangles)
{
    const Vector3d normal = area_vector(p);
    double least = 1.0;
    for (const Triangle& t : triangles)
        least = std::min(least, (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(normal) / normal.squaredNorm());
    return least;
}

/// Cuts the polygon as it is seen along its area vector. @returns none if its sides meet there
std::vector<Triangle> cut_in_plane(const Positions& positions)
{
    const Vector3d normal = area_vector(positions).stableNormalized(), right = normal.unitOrthogonal(),
                   up = normal.cross(right);
    std::vector<Complex> places;
    places.reserve(positions.size());
    for (const Vector3d& p : positions) places.emplace_back(p.dot(right), p.dot(up));
    std::vector<Triangle> triangles;
    const Triangles cut = divided_polygon(places, {}, {});
    for (Eigen::Index f = 0; f < cut.rows(); ++f) triangles.push_back({cut(f, 0), cut(f, 1), cut(f, 2)});
    return triangles;
}

/// CGAL's search turns triangles over, or makes triangles without area between corners on a straight side, whose long
/// edge is also a neighbour's. Then the plane decides.
std::vector<Triangle> cut_upright(const Positions& positions)
{
    std::vector<Triangle> cut = cut_polygon(positions);
    const double share = smallest_share(positions, cut);
    if (share < least_area) {
        std::vector<Triangle> in_plane = cut_in_plane(positions);
        if (in_plane.size() + 2 == positions.size() && smallest_share(positions, in_plane) > share) return in_plane;
    }
    return cut;
}

bool are_different(Index a, Index b, Index c) { return a != b && b != c && c != a; }

class Triangulator {
public:
    explicit Triangulator(const PolygonMesh& mesh) : mesh_(mesh)
    {
        triangles_.reserve(mesh.corners.size() - std::min<std::size_t>(mesh.corners.size(), 2 * mesh.face_count()));
        face_.reserve(triangles_.capacity());
    }

    void add_face(Index f)
    {
        const std::span<const Index> filed = mesh_.face(f);
        if (filed.size() == 3 && are_different(filed[0], filed[1], filed[2]))
            return add({filed[0], filed[1], filed[2]}, f);
        const Polygon polygon = distinct_corners(filed);
        if (polygon.size() < 3) return collapsed_.push_back(f);
        if (polygon.size() == 3) return add({polygon[0], polygon[1], polygon[2]}, f);
        if (repeats_an_edge(polygon)) return uncut_.push_back(f);
        const Positions positions = normalized_positions(mesh_.vertices, polygon);
        const std::vector<Triangle> cut = polygon.size() == 4 ? cut_quadrilateral(positions) : cut_upright(positions);
        const auto is_triangle = [&polygon](const Triangle& t) {
            return are_different(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
        };
        if (cut.size() + 2 != polygon.size() || !std::ranges::all_of(cut, is_triangle)) return uncut_.push_back(f);
        for (const Triangle& t : cut) add({polygon[t[0]], polygon[t[1]], polygon[t[2]]}, f);
    }

    Triangulation finish(bool refuse)
    {
        if (refuse && !uncut_.empty())
            throw InputError(std::to_string(uncut_.size()) + " polygons cannot be cut into triangles (faces listed)",
                             ElementKind::faces, uncut_);
        const Index* data = triangles_.empty() ? nullptr : triangles_.front().data();
        return {Eigen::Map<const Triangles>(data, static_cast<Eigen::Index>(triangles_.size()), 3), std::move(face_),
                std::move(collapsed_), std::move(uncut_)};
    }

private:
    void add(const Triangle& triangle, Index face)
    {
        triangles_.push_back(triangle);
        face_.push_back(face);
    }

    const PolygonMesh& mesh_;
    std::vector<Triangle> triangles_;
    std::vector<Index> face_, collapsed_, uncut_;
};

/// Keeps a mesh of triangles as it is.
Triangulation as_it_is(const PolygonMesh& mesh)
{
    Triangulation result;
    result.triangles.resize(mesh.face_count(), 3);
    result.face.resize(static_cast<std::size_t>(mesh.face_count()));
    constexpr std::size_t at_a_time = 32768;
    in_pieces(result.face.size(), at_a_time, [&](std::size_t begin, std::size_t end) {
        std::copy(mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * begin),
                  mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * end), result.triangles.data() + 3 * begin);
        std::iota(result.face.begin() + static_cast<std::ptrdiff_t>(begin),
                  result.face.begin() + static_cast<std::ptrdiff_t>(end), static_cast<Index>(begin));
    });
    return result;
}

}  // namespace

Triangulation triangulate(const PolygonMesh& mesh, bool refuse)
{
    const auto is_no_triangle = [&](Index f) {
        const std::span<const Index> face = mesh.face(f);
        return face.size() != 3 || !are_different(face[0], face[1], face[2]);
    };
    if (found_in_pieces(mesh.face_count(), is_no_triangle).empty()) return as_it_is(mesh);
    const SilentCgal silent;
    Triangulator triangulator(mesh);
    for (Index f = 0; f < mesh.face_count(); ++f) triangulator.add_face(f);
    return triangulator.finish(refuse);
}

}  // namespace koebe
