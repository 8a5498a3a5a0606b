#include "sphere/even_sphere.h"

#include "even/even_map.h"
#include "even/wanted_shapes.h"
#include "sphere/elastic_sphere.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double nearest_size = 8.0;  // most ratio of the area that a face wants next to its present area,
constexpr double few_far_off = 1e-3;  // until sizes differ by more only on this share of the area
constexpr int most_approaches = 30;
constexpr int steps_an_approach = 4;
constexpr int last_steps = 60;
constexpr double settled_fall = 5e-4;   // relative decrease of the energy
constexpr double lightest_face = 1e-3;  // weight of a face, over the mean

}  // namespace

bool make_sphere_even(const PeriodicSurface& domain, double even, Vertices& points, const ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    if (!all_upright(triangles, points)) return false;
    const auto area_now = [&](Eigen::Index f) { return 0.5 * flat_edges(points, triangles, f).determinant(); };
    double covered = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) covered += area_now(f);
    const Vertices surface = domain.vertices / scale_to_size(domain.vertices, triangles, 1.0) * std::sqrt(covered);
    const PatchShapes shapes = wanted_shapes(surface, triangles, PlanarPoints::Zero(points.rows(), 2), {});
    ElasticSphere sphere{triangles, shapes.references, shapes.areas.cwiseMax(lightest_face * shapes.areas.mean())};
    sphere.weight /= sphere.weight.sum();
    sphere.area_weight = area_weight(even);
    sphere.held.assign(static_cast<std::size_t>(points.rows()), 0);
    for (const VertexLoop& loop : domain.loops)
        for (const Index v : loop) sphere.held[v] = 1;
    KeptFactor factor;
    int steps = 0;
    for (int approach = 0; approach < most_approaches; ++approach) {
        double far = 0.0;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            const double ratio = shapes.areas[f] / area_now(f);
            const double wanted = std::clamp(ratio, 1.0 / nearest_size, nearest_size);
            if (wanted != ratio) far += shapes.areas[f];
            sphere.reference[f] = shapes.references[f] * std::sqrt(wanted / ratio);
        }
        if (!(far > few_far_off * shapes.areas.sum())) break;
        steps += relax_on_sphere(sphere, points, steps_an_approach, settled_fall, factor, context).steps;
    }
    sphere.reference = shapes.references;
    steps += relax_on_sphere(sphere, points, last_steps, settled_fall, factor, context).steps;
    return steps > 0;
}

}  // namespace koebe
