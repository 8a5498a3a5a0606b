#include "sphere/opened_sphere.h"

#include "core/errors.h"
#include "pipeline/uniformize.h"
#include "sphere/sphere_check.h"
#include "sphere/spherical_balance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace koebe {
namespace {

constexpr std::size_t tried_vertices = 5;
constexpr double far_point = 1e150;  // stands for infinity in the plane

/// Vertices by falling area of the upright faces around them on the sphere.
std::vector<Index> vertices_by_star(const Triangles& triangles, const Vertices& points)
{
    VectorXd area = VectorXd::Zero(points.rows());
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const double own =
            solid_angle(points.row(triangles(f, 0)), points.row(triangles(f, 1)), points.row(triangles(f, 2)));
        for (const Index v : triangles.row(f)) area[v] += std::max(own, 0.0);
    }
    std::vector<Index> order(static_cast<std::size_t>(points.rows()));
    std::iota(order.begin(), order.end(), 0);
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
