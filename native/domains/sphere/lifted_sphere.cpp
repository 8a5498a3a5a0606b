#include "sphere/lifted_sphere.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "pipeline/uniformize.h"
#include "sphere/sphere_check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace koebe {
namespace {

constexpr double least_angle = 1e-7;           // between neighbours on a circle, seen from its middle
constexpr std::size_t further_effort = 30000;  // of the repair of each further version (sphere_repair.h)
constexpr std::size_t tried_vertices = 5;
constexpr double far_point = 1e150;  // stands for infinity in the plane

/// Attaches an ear inside its hole, mirrored at its hinge. In the disk the unit circle is convex, and the ear lies
/// behind its hinge; on the sphere it would lie over its neighbours.
void attach_in_hole(const PeriodicSurface& domain, const Ear& ear, SphericalMap& sphere)
{
    const Triangles& triangles = domain.surface.triangles;
    std::size_t flipped = 0;
    for (const Index f : ear.faces) flipped += upright_on_sphere(triangles, sphere.points, f) ? 0 : 1;
    const SpherePoint normal =
        SpherePoint(sphere.points.row(ear.first)).cross(SpherePoint(sphere.points.row(ear.last)));
    if (2 * flipped <= ear.faces.size() || !(normal.norm() > 0.0)) return;
    const Eigen::RowVector3d across = normal.normalized().transpose();
    for (const auto* vertices : {&ear.rim, &ear.interior})
        for (const Index v : *vertices) {
            const Eigen::RowVector3d at = sphere.points.row(v);
            sphere.points.row(v) = (at - 2.0 * at.dot(across) * across).normalized();
        }
    sphere.off_circle.insert(sphere.off_circle.end(), ear.rim.begin(), ear.rim.end());
}

/// Puts the vertices of a loop on its cap's circle in their order round it. Moves two apart that rounding has exchanged
/// or put at one point.
void put_onto_circle(const std::vector<Index>& vertices, const Cap& cap, Vertices& points)
{
    if (vertices.empty()) return;
    const SpherePoint x = cap.center.unitOrthogonal(), y = cap.center.cross(x);
    const std::size_t count = vertices.size();
    std::vector<double> angle;  // the loop runs clockwise
    for (const Index v : vertices) angle.push_back(-std::atan2(points.row(v).dot(y), points.row(v).dot(x)));
    const auto step = [&](std::size_t b) {  // from b to the next, in [-pi, pi]
        return std::remainder(angle[(b + 1) % count] - angle[b], 2.0 * std::numbers::pi);
    };
    std::size_t widest = 0;
    for (std::size_t b = 1; b < count; ++b)
        if (step(b) > step(widest)) widest = b;
    double at = angle[(widest + 1) % count], raised = at;
    for (std::size_t i = 0; i < count; ++i) {  // starts after the widest step
        const std::size_t b = (widest + 1 + i) % count;
        const double following = at + step(b);
        raised = i == 0 ? at : std::max(at, raised + least_angle);
        const SpherePoint across = std::cos(raised) * x - std::sin(raised) * y;
        const SpherePoint place =
            raised == at ? onto_circle(cap, points.row(vertices[b]).transpose()) : onto_circle(cap, across);
        points.row(vertices[b]) = place.transpose();
        at = following;
    }
}

/// Lifts a map to the sphere, with loops on their circles.
SphericalMap lifted_to_sphere(const PeriodicSurface& domain, const PlaneMap& map, const PlaneSimilarity& move)
{
    SphericalMap sphere;
    sphere.points = on_sphere(move(map.z));
    sphere.off_circle = map.off_circle;
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        const Circle& circle = map.circles[k];
        sphere.caps.push_back(cap_of({move(circle.center), circle.radius / move.scale}, k == map.outer));
        std::vector<Index> on;
        for (const Index v : domain.loops[k])
            if (!std::ranges::binary_search(map.off_circle, v)) on.push_back(v);
        put_onto_circle(on, sphere.caps[k], sphere.points);
    }
    for (const Ear& ear : map.ears) attach_in_hole(domain, ear, sphere);
    sort_unique(sphere.off_circle);
    return sphere;
}

/// Vertices by falling area of the upright faces around them on the sphere.
std::vector<Index> vertices_by_star(const Triangles& triangles, const Vertices& points)
{
    VectorXd area = VectorXd::Zero(points.rows());
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const double own =
            solid_angle(points.row(triangles(f, 0)), points.row(triangles(f, 1)), points.row(triangles(f, 2)));
        for (const Index v : triangles.row(f)) area[v] += std::max(own, 0.0);
    }
    std::vector<Index> order = numbers_below(points.rows());
    std::ranges::stable_sort(order, [&](Index a, Index b) { return area[a] > area[b]; });
    return order;
}

/// (V) places in the plane, with the vertex far away.
VectorXcd plane_without(const PeriodicSurface& domain, Index vertex, ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    std::vector<Eigen::Index> rest;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if ((triangles.row(f).array() != vertex).all()) rest.push_back(f);
    ExecutionContext own({}, {}, [&] { context.checkpoint(); });
    const UniformizeResult disk = uniformize_here(domain.vertices, triangles(rest, Eigen::all), {}, own);
    VectorXcd z(domain.surface.vertex_count);
    for (Index v = 0; v < domain.surface.vertex_count; ++v) z[v] = {disk.uv(v, 0), disk.uv(v, 1)};
    z[vertex] = far_point;
    return z;
}

}  // namespace

SphericalMap lifted_sphere(const PeriodicSurface& domain, const PlaneMap& map, const PlaneSimilarity& balance,
                           bool& drawn, const ExecutionContext& context)
{
    const auto drawn_by = [&](double farther, std::size_t effort) {
        SphericalMap sphere = lifted_to_sphere(domain, map, {balance.shift, balance.scale * std::exp(farther)});
        if (effort > 0) turn_back_on_sphere(domain, sphere, context, effort);
        return sphere;
    };
    const auto whole = [&](const SphericalMap& sphere) {
        return !find_sphere_faults(domain.surface.triangles, domain.loops, sphere.points, sphere.caps).any();
    };
    SphericalMap balanced = drawn_by(0.0, whole_effort);
    drawn = false;
    if (domain.loops.empty() || domain.surface.triangles.rows() > most_drawn_faces || whole(balanced)) return balanced;
    for (const std::size_t effort : {std::size_t{0}, further_effort})
        for (const double farther : {0.01, 0.04, 0.16, 0.64, 2.56}) {
            if (effort > 0 && farther < 0.1) continue;
            SphericalMap sphere = drawn_by(farther, effort);
            if (!whole(sphere)) continue;
            drawn = true;
            return sphere;
        }
    return balanced;
}

std::optional<SphericalMap> opened_at_a_vertex(const PeriodicSurface& domain, const VectorXd& weights,
                                               const Vertices& points, ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    std::vector<Index> order = vertices_by_star(triangles, points);
    order.resize(std::min(order.size(), tried_vertices));
    for (const Index vertex : order) {
        context.checkpoint();
        VectorXcd z;
        try {
            z = plane_without(domain, vertex, context);
        } catch (const Cancelled&) {
            throw;
        } catch (const KoebeError&) {
            continue;  // the rest is not a disk
        }
        const PlaneSimilarity balance = balance_on_sphere(z, weights).move;
        for (const PlaneSimilarity& move : {balance, PlaneSimilarity{0.0, 1.02}, PlaneSimilarity{0.0, 1.3}}) {
            SphericalMap map;
            map.points = on_sphere(move(z));
            turn_back_on_sphere(domain, map, context);
            if (!find_sphere_faults(triangles, {}, map.points, {}).any()) return map;
        }
    }
    return std::nullopt;
}

}  // namespace koebe
