#include "holes/fair_filling.h"

#include "core/errors.h"
#include "core/silent_cgal.h"
#include "holes/aged_cells.h"
#include "mesh/topology.h"

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

namespace koebe {
namespace {

using Kernel = KernelOfAgedCells;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Largest number of corners for the cubic method, the last resort, which then takes a second.
constexpr std::size_t cubic_corners = 500;

/// A patch as fine as its surroundings has about 0.13 n^2 triangles for n edges, with CGAL's factor sqrt(2). Their
/// number grows with the factor's square, the time of fairing grows faster (80,000 triangles take 4 s).
constexpr double fine = std::numbers::sqrt2, triangles_per_square = 0.13;
/// A patch with more triangles is made coarser than its surroundings, with at least so many per edge of the loop.
constexpr double enough_triangles = 10000.0, least_per_edge = 4.0;

/// Loop edges that are shorter than this share of the mean are made that long while the patch is made.
constexpr double shortest_edge = 1e-2;

double density(double edges)
{
    const double triangles = std::max(enough_triangles, least_per_edge * edges);
    return fine * std::min(1.0, std::sqrt(triangles / triangles_per_square) / edges);
}

/// How the curvature is continued. A patch as fine as its surroundings takes one solution of third order (a spherical
/// cap of 0.8 radians: 1.6 % of the radius off). Slender triangles at the rim, of a coarser patch or at edges below a
/// tenth of the mean, turn that into spikes. Then the equations are of second order, which keep the tangent planes
/// only. Solved again with the weights of the new shape, they bend evenly (5 % off after one solution, 3 % after
/// three).
struct Fairing {
    unsigned int continuity, solutions;
};

Fairing fairing(double density, bool is_even) { return density < fine || !is_even ? Fairing{1, 3} : Fairing{2, 1}; }

/// Moves and scales a surface into the unit cube and back, so that no square over- or underflows.
class UnitCube {
public:
    explicit UnitCube(const Vertices& vertices)
    {
        const Eigen::RowVector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
        center_ = 0.5 * low + 0.5 * high;
        const double half = (0.5 * high - 0.5 * low).maxCoeff();
        if (half > 0.0) scale_ = half;
    }
    Kernel::Point_3 inside(const Eigen::RowVector3d& p) const
    {
        const Eigen::RowVector3d q = (p - center_) / scale_;
        return {q[0], q[1], q[2]};
    }
    Eigen::RowVector3d outside(const Kernel::Point_3& q) const
    {
        return center_ + scale_ * Eigen::RowVector3d(q.x(), q.y(), q.z());
    }

private:
    Eigen::RowVector3d center_;
    double scale_ = 1.0;
};

Mesh cgal_mesh(const Vertices& vertices, const Triangles& triangles, const UnitCube& cube)
{
    Mesh mesh;
    mesh.reserve(vertices.rows(), 3 * triangles.rows() / 2 + 1, triangles.rows());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) mesh.add_vertex(cube.inside(vertices.row(v)));
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        mesh.add_face(Mesh::Vertex_index(triangles(f, 0)), Mesh::Vertex_index(triangles(f, 1)),
                      Mesh::Vertex_index(triangles(f, 2)));
    return mesh;
}

bool has_extent(const Vertices& vertices, const VertexLoop& loop)
{
    const Vertices positions = vertices(loop, Eigen::all);
    return positions.colwise().maxCoeff() != positions.colwise().minCoeff();
}

/// Moves vertices of a loop that coincide with the vertex before, or nearly, on along the loop: the refinement does not
/// end with doubled vertices.
void part_doubled(Mesh& mesh, const VertexLoop& loop)
{
    const std::size_t n = loop.size();
    const auto point = [&](std::size_t i) -> Kernel::Point_3& { return mesh.point(Mesh::Vertex_index(loop[i % n])); };
    const auto distance = [](const auto& p, const auto& q) { return std::sqrt(CGAL::squared_distance(p, q)); };
    double length = 0.0;
    for (std::size_t i = 0; i < n; ++i) length += distance(point(i), point(i + 1));
    const double shortest = shortest_edge * length / static_cast<double>(n);
    for (std::size_t anchor = 0, next; anchor < n; anchor = next) {
        for (next = anchor + 1; next < n && distance(point(anchor), point(next)) < shortest;) ++next;
        const Kernel::Vector_3 way = point(next) - point(anchor);
        const double far = std::sqrt(way.squared_length());
        for (std::size_t i = anchor + 1; i < next && far > 0.0; ++i)
            point(i) = point(anchor) + shortest * static_cast<double>(i - anchor) / far * way;
    }
}

/// Whether every edge of a loop has at least a tenth of the mean length.
bool is_even(const Mesh& mesh, const VertexLoop& loop)
{
    const std::size_t n = loop.size();
    double sum = 0.0, least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
        const double length = std::sqrt(CGAL::squared_distance(mesh.point(Mesh::Vertex_index(loop[i])),
                                                               mesh.point(Mesh::Vertex_index(loop[(i + 1) % n]))));
        sum += length;
        least = std::min(least, length);
    }
    return least >= 0.1 * sum / static_cast<double>(n);
}

/// Two vertices of a loop at the same place, if any.
std::vector<Index> meeting_vertices(const Mesh& mesh, const VertexLoop& loop)
{
    VertexLoop order = loop;
    const auto point = [&](Index v) { return mesh.point(Mesh::Vertex_index(v)); };
    std::ranges::sort(order, [&](Index a, Index b) { return point(a) < point(b); });
    const auto pair = std::ranges::adjacent_find(order, [&](Index a, Index b) { return point(a) == point(b); });
    return pair == order.end() ? std::vector<Index>{} : std::vector<Index>{pair[0], pair[1]};
}

/// The solution of a singular system is not finite, and the exact arithmetic that reads it next would end the process.
bool are_finite(const Mesh& mesh, const std::vector<Mesh::Vertex_index>& vertices)
{
    return std::ranges::all_of(vertices, [&](Mesh::Vertex_index v) {
        const Kernel::Point_3& p = mesh.point(v);
        return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
    });
}

/// Adds one patch to the mesh.
void fill_hole(Mesh& mesh, const VertexLoop& loop)
{
    namespace pmp = CGAL::Polygon_mesh_processing;
    const auto ignore = boost::make_function_output_iterator([](const auto&) {});
    // The surface is on the loop's left, the hole's half-edge on the other side of its edges.
    const Mesh::Halfedge_index hole = mesh.halfedge(Mesh::Vertex_index(loop[1]), Mesh::Vertex_index(loop[0]));
    const std::size_t faces = mesh.number_of_faces();
    const double factor = density(static_cast<double>(loop.size()));
    const auto [continuity, solutions] = fairing(factor, is_even(mesh, loop));
    std::vector<Mesh::Vertex_index> added;
    bool fair = false;
    try {
        fair = std::get<0>(
            pmp::triangulate_refine_and_fair_hole(mesh, hole, ignore, std::back_inserter(added),
                                                  CGAL::parameters::geom_traits(Kernel())
                                                      .do_not_use_cubic_algorithm(loop.size() >= cubic_corners)
                                                      .density_control_factor(factor)
                                                      .fairing_continuity(continuity)));
        fair = fair && are_finite(mesh, added);
        for (unsigned int i = 1; i < solutions && fair; ++i)
            fair = pmp::fair(mesh, added, CGAL::parameters::fairing_continuity(continuity)) && are_finite(mesh, added);
    } catch (const CGAL::Failure_exception&) {
        throw InputError("a boundary loop cannot be filled (vertices listed)", ElementKind::vertices, loop);
    }
    if (mesh.number_of_faces() == faces)
        throw InputError("a boundary loop cannot be triangulated (vertices listed)", ElementKind::vertices, loop);
    if (!fair)
        throw SolverError("the patch of a boundary loop cannot be faired (vertices listed)", ElementKind::vertices,
                          loop);
}

}  // namespace

FilledSurface fill_and_fair_holes(const Vertices& vertices, const Triangles& triangles,
                                  const std::optional<std::vector<Index>>& loops)
{
    validate_arrays(vertices, triangles);
    const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    const SilentCgal silent;
    const UnitCube cube(vertices);
    Mesh mesh = cgal_mesh(vertices, surface.triangles, cube);
    std::vector<Index> label(surface.triangles.rows(), -1);
    for (const Index k : chosen_ranks(surface, loops)) {
        if (!has_extent(vertices, surface.loops[k]))
            throw InputError("a boundary loop has no extent (vertices listed)", ElementKind::vertices,
                             surface.loops[k]);
        part_doubled(mesh, surface.loops[k]);
        if (const std::vector<Index> pair = meeting_vertices(mesh, surface.loops[k]); !pair.empty())
            throw InputError(
                "a boundary loop has two vertices at one place (vertices listed): merge these vertices, or "
                "move them apart",
                ElementKind::vertices, pair);
        fill_hole(mesh, surface.loops[k]);
        label.resize(mesh.number_of_faces(), k);
    }

    // The surface keeps its vertices and faces, and their numbers; the patches follow.
    FilledSurface filled{Vertices(mesh.number_of_vertices(), 3), Triangles(mesh.number_of_faces(), 3), std::move(label),
                         filling_warnings(surface.reoriented)};
    filled.vertices.topRows(vertices.rows()) = vertices;
    filled.triangles.topRows(triangles.rows()) = triangles;
    for (Eigen::Index v = vertices.rows(); v < filled.vertices.rows(); ++v)
        filled.vertices.row(v) = cube.outside(mesh.point(Mesh::Vertex_index(v)));
    for (Eigen::Index f = surface.triangles.rows(); f < filled.triangles.rows(); ++f) {
        int c = 0;
        for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(Mesh::Face_index(f))))
            filled.triangles(f, c++) = static_cast<Index>(v.idx());
    }
    if (!filled.vertices.allFinite()) throw SolverError("a patch has positions that are not finite");
    return filled;
}

}  // namespace koebe
