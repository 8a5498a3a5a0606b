#include "shape/module_error.h"

#include "core/api.h"
#include "core/types.h"
#include "mesh/loop_with.h"
#include "mesh/topology.h"
#include "pipeline/uniformize.h"
#include "shape/conformal_module.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace koebe {
namespace {

struct RefinedSurface {
    Vertices vertices;    ///< (V + E, 3) the input's vertices first
    Triangles triangles;  ///< (4F, 3) in one orientation
};

using Point = Eigen::RowVector3d;

constexpr double least_cosine = 0.5;  // of the turn between two edges of a smooth rim

Vertices vertex_normals(const Vertices& vertices, const Triangles& triangles)
{
    Vertices normals = Vertices::Zero(vertices.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Point a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                    c = vertices.row(triangles(f, 2));
        for (const Index v : triangles.row(f)) normals.row(v) += (b - a).cross(c - a);
    }
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
        const double length = normals.row(v).norm();
        if (length > 0.0) normals.row(v) /= length;
    }
    return normals;
}

/// Curvature of a polygon at its vertex b; nothing at a corner.
std::optional<Point> curvature(const Point& a, const Point& b, const Point& c)
{
    const Point in = b - a, out = c - b;
    const double before = in.norm(), after = out.norm();
    if (!(in.dot(out) > least_cosine * before * after)) return {};
    return 2.0 * (out / after - in / before) / (before + after);
}

Point inner_middle(const Point& p, const Point& q, const Point& normal_p, const Point& normal_q)
{
    const Point edge = q - p;
    return 0.5 * (p + q) - 0.125 * (edge.dot(normal_p) * normal_p - edge.dot(normal_q) * normal_q);
}

Point rim_middle(const Point& before, const Point& p, const Point& q, const Point& after)
{
    const std::optional<Point> at_p = curvature(before, p, q), at_q = curvature(p, q, after);
    const Point middle = 0.5 * (p + q);
    if (!at_p || !at_q) return middle;
    // On a circle the mean of both curvatures is root times the circle's, and the arc is so far from its chord.
    const double square = (q - p).squaredNorm();
    const double root = std::sqrt(1.0 - std::min(0.5, 0.25 * square * at_p->norm() * at_q->norm()));
    return middle - square / (8.0 * root * (1.0 + root)) * (*at_p + *at_q);
}

/// Cuts each face in four and puts the new vertices on the smooth surface. Inside, a new vertex lies on the cubic over
/// its edge that is perpendicular to the normals at the ends (Vlachos et al. 2001, "Curved PN triangles", section 3).
/// At a rim it lies on the arc with the mean of the curvatures at the edge's ends. Where a rim turns by more than 60
/// degrees it has a corner, and the edges at it stay straight. Flat regions stay flat.
/// @throws TopologyError as analyze_surface
RefinedSurface refine_smoothly(const Vertices& vertices, const Triangles& triangles)
{
    const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    const Triangles& faces = surface.triangles;
    const Vertices normals = vertex_normals(vertices, faces);

    std::vector<Index> middle(surface.twin.size(), -1);  // the new vertex of each half-edge
    std::vector<Point> added;
    const auto number = [&] { return static_cast<Index>(vertices.rows()) + static_cast<Index>(added.size()); };
    std::vector<Index> rim_edge_from(vertices.rows(), -1);  // the rim half-edge that begins at each vertex
    for (Index h = 0; h < static_cast<Index>(middle.size()); ++h) {
        const Index p = faces(h / 3, h % 3), q = faces(h / 3, (h + 1) % 3), twin = surface.twin[h];
        if (twin < 0) {
            rim_edge_from[p] = h;
        } else if (middle[h] < 0) {
            middle[h] = middle[twin] = number();
            added.push_back(inner_middle(vertices.row(p), vertices.row(q), normals.row(p), normals.row(q)));
        }
    }
    for (const VertexLoop& loop : surface.loops) {
        const std::size_t count = loop.size();
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = [&](std::size_t k) { return Point(vertices.row(loop[(i + k) % count])); };
            const Index h = rim_edge_from[loop[i]];
            middle[h] = number();
            added.push_back(rim_middle(at(count - 1), at(0), at(1), at(2)));
        }
    }

    RefinedSurface refined{Vertices(number(), 3), Triangles(4 * faces.rows(), 3)};
    refined.vertices.topRows(vertices.rows()) = vertices;
    for (std::size_t i = 0; i < added.size(); ++i)
        refined.vertices.row(vertices.rows() + static_cast<Eigen::Index>(i)) = added[i];
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const Index a = faces(f, 0), b = faces(f, 1), c = faces(f, 2);
        const Index ab = middle[3 * f], bc = middle[3 * f + 1], ca = middle[3 * f + 2];
        refined.triangles.row(4 * f) << a, ab, ca;
        refined.triangles.row(4 * f + 1) << ab, b, bc;
        refined.triangles.row(4 * f + 2) << ca, bc, c;
        refined.triangles.row(4 * f + 3) << ab, bc, ca;
    }
    return refined;
}

}  // namespace

std::vector<Circle> refined_circles(const Vertices& vertices, const Triangles& triangles,
                                    const std::vector<LoopReport>& loops, UniformizeOptions options,
                                    ExecutionContext& context)
{
    const RefinedSurface refined = refine_smoothly(vertices, triangles);
    options.outer = OuterLoop::vertex;
    options.outer_vertex = loops[0].vertices.front();
    options.polish = options.mesh.record_steps = false;  // these do not change circles
    const UniformizeResult result = uniformize(refined.vertices, refined.triangles, options, context);
    require_own_circles(result.loops);
    std::vector<Circle> circles;
    for (const LoopReport& loop : loops) {
        const int same = loop_with(result.loops, loop.vertices.front(), &LoopReport::vertices);
        circles.push_back(result.loops.at(same).circle);
    }
    return circles;
}

VectorXd module_error(const VectorXd& module, const VectorXd& refined)
{
    VectorXd change = (refined - module).cwiseAbs();
    if (change.size() == 0) return change;
    const double typical = change.norm() / std::sqrt(static_cast<double>(change.size()));
    return 2.0 * change + VectorXd::Constant(change.size(), typical);
}

}  // namespace koebe
