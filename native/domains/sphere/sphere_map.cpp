#include "sphere/sphere_map.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/enum_words.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "core/types.h"
#include "even/even_map.h"
#include "execution/each_in_pieces.h"
#include "execution/execution.h"
#include "foldover/convex_polygons.h"
#include "linear/dense_spd.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/take_verdict.h"
#include "sphere/elastic_sphere.h"
#include "sphere/lifted_sphere.h"
#include "sphere/plane_map.h"
#include "sphere/sphere_check.h"
#include "sphere/sphere_layout.h"
#include "sphere/sphere_repair.h"
#include "sphere/spherical_balance.h"
#include "surface/laplacian.h"
#include "surface/periodic_surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr std::size_t rounding_effort = 30000;  // to turn back faces that rounding in a rotation has turned over

/// (V) directions from the surface's middle.
Vertices directions_of(const PeriodicSurface& domain, const VectorXd& weights)
{
    const Eigen::RowVector3d middle = weights.transpose() * domain.vertices / std::max(weights.sum(), 1e-300);
    Vertices directions = domain.vertices.rowwise() - middle;
    each_in_pieces(directions.rows(), [&](Eigen::Index v) {
        if (const double length = directions.row(v).norm(); length > 0.0) directions.row(v) /= length;
    });
    return directions;
}

/// Measures each face flat, as the triangle between its corners on the sphere.
ComputedDistortion distortion_on_sphere(const PeriodicSurface& domain, const Vertices& points)
{
    const Triangles& triangles = domain.surface.triangles;
    PlanarPoints flat(triangles.size(), 2);
    each_in_pieces(static_cast<Index>(triangles.rows()), [&](Index f) {
        const SpherePoint a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)).transpose() - a,
                          c = points.row(triangles(f, 2)).transpose() - a;
        const double along = b.norm(), share = along > 0.0 ? b.dot(c) / along : 0.0;
        const double height = along > 0.0 ? b.cross(c).norm() / along : c.norm();
        flat.row(3 * f) << 0.0, 0.0;
        flat.row(3 * f + 1) << along, 0.0;
        flat.row(3 * f + 2) << share, upright_on_sphere(triangles, points, f) ? height : -height;
    });
    return measure_corner_distortion(domain.vertices, triangles, flat);
}

std::vector<Index> named(const PeriodicSurface& domain, const std::vector<Index>& vertices)
{
    std::vector<Index> result = values_at(domain.original, vertices);
    std::ranges::sort(result);
    return result;
}

std::vector<SphereLoop> loops_on_sphere(const PeriodicSurface& domain, const PlaneMap& map, const SphericalMap& sphere)
{
    std::vector<SphereLoop> loops;
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        SphereLoop& loop = loops.emplace_back();
        loop.vertices = domain.named_loop(k);
        loop.off_circle = domain.named_on_loop(k, sphere.off_circle);
        loop.cap = sphere.caps[k];
        loop.roundness = map.roundness[k];
    }
    return loops;
}

/// Faces whose UVs are not one to one, except those below the resolution of 32-bit UVs.
std::vector<Index> misplaced_faces(const SphereLayoutReport& layout)
{
    std::vector<Index> all = layout.torn, result;
    all.insert(all.end(), layout.flipped.begin(), layout.flipped.end());
    sort_unique(all);
    std::ranges::set_difference(all, layout.below_resolution, std::back_inserter(result));
    return result;
}

/// How a map fills the sphere.
enum class Spread {
    balanced,
    drawn_together,  ///< few faces: none as large as half the sphere
    opened,          ///< at a vertex, as faces of the balanced map turn over
    unbalanced       ///< half of the surface shrinks to a point
};

void warn_of_sphere(const PeriodicSurface& domain, const PlaneMap& map, const SphericalMap& sphere,
                    const SphereFaults& faults, Spread spread, SphereResult& result)
{
    result.warnings = map.warnings;
    warn_reoriented(domain.surface.reoriented, result.warnings);
    warn_inside_out(domain.vertices, domain.surface, result.warnings);
    std::vector<Index> unused = numbers_below(result.vertex_count);
    std::erase_if(unused, [&](Index v) { return std::ranges::binary_search(domain.original, v); });
    if (!unused.empty())
        result.warnings.push_back({WarningKind::unused_vertices,
                                   counted(unused.size(), "vertex") + " without a face, put at (0, 0, 1)",
                                   std::move(unused)});
    // How far the map on the sphere is the one wanted.
    if (domain.loops.empty() && !map.converged)
        result.warnings.push_back({WarningKind::not_converged, "the iteration ended before it reached its tolerance"});
    if (spread == Spread::drawn_together)
        result.warnings.push_back(
            {WarningKind::coarse_mesh, "too few faces to spread them evenly over the sphere: they lie close together"});
    else if (spread == Spread::opened)
        result.warnings.push_back(
            {WarningKind::coarse_mesh, "faces of the balanced map turn over: a map opened at a vertex replaces it"});
    else if (spread == Spread::unbalanced)
        result.warnings.push_back({WarningKind::not_converged,
                                   "no even spread over the sphere was found: half of the surface shrinks to a point"});
    // Where the map on the sphere is lost in rounding.
    warn_off_circle(named(domain, sphere.off_circle), result.warnings);
    if (!faults.lost_holes.empty())
        result.warnings.push_back({WarningKind::lost_circles,
                                   counted(faults.lost_holes.size(), "loop") + " too deep for 64-bit coordinates",
                                   {faults.lost_holes.begin(), faults.lost_holes.end()}});
    if (!faults.below_resolution.empty())
        result.warnings.push_back(
            {WarningKind::below_resolution,
             counted(faults.below_resolution.size(), "face") + " on the sphere too small for 64-bit coordinates",
             faults.below_resolution});
    // Where the layout is lost in rounding, or cannot draw what the sphere has.
    const auto& tiny = result.layout.below_resolution;
    if (!tiny.empty())
        result.warnings.push_back(
            {WarningKind::below_resolution, counted(tiny.size(), "face") + " flipped, too small for 32-bit UVs", tiny});
    if (const std::vector<Index> misplaced = misplaced_faces(result.layout); !misplaced.empty()) {
        std::string hint = "The other layout, or finer faces, may have room for them";
        if (result.layout.kind == SphereLayout::octahedral)
            hint =
                "Four vertices lie at the middles of the square's sides, and faces are straight between them. " + hint;
        result.warnings.push_back(
            {WarningKind::flipped,
             counted(misplaced.size(), "face") + " flipped or torn in the UVs, upright on the sphere", misplaced,
             std::move(hint)});
    }
    if (!faults.any()) return;
    warn_not_one_to_one(faults.flipped, faults.below_resolution,
                        {faults.holes.empty() ? "" : counted(faults.holes.size(), "loop") + " out of shape",
                         faults.covering ? "the sphere is not covered once" : ""},
                        result.warnings);
}

/// @param options in the numbers of the canonical mesh
SphereResult sphere_map_here(const CanonicalMesh& mesh, const SphereOptions& options, ExecutionContext& context)
{
    const Vertices& vertices = mesh.vertices;
    const Triangles& triangles = mesh.triangles;
    require_even(options.even);
    fix_product_blocks();
    MapClock clock;
    SphereResult result;
    context.begin_stage("topology", 0.0, 0.1);
    const PeriodicSurface domain = periodless_sphere(vertices, triangles);
    VectorXd weights = vertex_areas(domain.surface.triangles, edge_lengths(domain.vertices, domain.surface.triangles),
                                    domain.surface.vertex_count);
    if (!(weights.sum() > 0.0)) weights.setOnes();  // a surface without area is spread by its vertices
    clock.end(&StageSeconds::topology);
    context.begin_stage("iterate", 0.1, 0.8);
    const PlaneMap map = plane_map(vertices, triangles, domain, weights, options, context);
    clock.take(map.seconds);

    // Onto the sphere by stereographic projection, evenly spread by a Moebius map.
    context.begin_stage("finish", 0.8, 1.0);
    const SphericalBalance balance = balance_on_sphere(map.z, weights);
    bool drawn = false;
    SphericalMap sphere = lifted_sphere(domain, map, balance.move, drawn, context);
    Spread spread = drawn ? Spread::drawn_together : balance.balanced ? Spread::balanced : Spread::unbalanced;
    if (domain.loops.empty() && domain.surface.triangles.rows() <= most_drawn_faces &&
        find_sphere_faults(domain.surface.triangles, {}, sphere.points, {}).any())
        if (auto other = opened_at_a_vertex(domain, weights, sphere.points, context)) {
            sphere = std::move(*other);
            if (!drawn) spread = Spread::opened;
        }
    result.even =
        options.even > 0.0 && make_sphere_even(domain, options.even, sphere.points, context) ? options.even : 0.0;
    // The turn that lays the directions of the surface over those of the sphere.
    const Eigen::Matrix3d turn = mesh.turn * best_rotation(sphere.points, directions_of(domain, weights), weights);
    each_in_pieces(sphere.points.rows(), [&](Eigen::Index v) {
        sphere.points.row(v) = (turn * sphere.points.row(v).transpose()).normalized().transpose();
    });
    for (Cap& cap : sphere.caps) cap.center = (turn * cap.center).normalized();
    turn_back_on_sphere(domain, sphere, context, rounding_effort);
    result.mean_point = (weights.transpose() * sphere.points).norm() / weights.sum();

    const SphereFaults faults = find_sphere_faults(domain.surface.triangles, domain.loops, sphere.points, sphere.caps);
    // The layout, in the numbers of the input, and the verdict on both.
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    result.points = Vertices::Zero(vertices.rows(), 3);
    result.points.col(2).setOnes();
    for (Index v = 0; v < domain.surface.vertex_count; ++v)
        result.points.row(domain.original[v]) = sphere.points.row(v);
    result.turned = domain.surface.reoriented;
    std::vector<char> turned(static_cast<std::size_t>(triangles.rows()), 0);
    for (const Index f : result.turned) turned[f] = 1;
    std::vector<char> on_loop(static_cast<std::size_t>(vertices.rows()), 0);
    for (const VertexLoop& loop : domain.loops)
        for (const Index v : loop) on_loop[domain.original[v]] = 1;
    result.uv = sphere_layout({triangles, result.points, turned, on_loop, options.polygon}, options.layout,
                              result.layout, context);
    result.loops = loops_on_sphere(domain, map, sphere);
    result.distortion = {distortion_on_sphere(domain, sphere.points),
                         judge_corners(vertices, triangles, result.uv, result.turned)};
    result.layout.flipped = result.distortion.flipped;
    result.layout.below_resolution = result.distortion.below_resolution;
    result.flipped_on_sphere = faults.flipped;
    result.below_sphere_resolution = faults.below_resolution;
    result.converged =
        map.converged && !faults.any() && spread != Spread::unbalanced && misplaced_faces(result.layout).empty();
    result.sweeps = map.sweeps;
    result.changes = map.changes;
    warn_of_sphere(domain, map, sphere, faults, spread, result);
    if (*result.even < options.even) warn_not_even({}, result.warnings);
    warn_concave_polygons({vertices, triangles, options.polygon, result.turned}, result.uv, result.warnings);
    take_verdict(
        {.most_lost = options.most_lost, .advice = "Finer faces, the other layout or parts (koebe parts) lose less"},
        result);
    clock.finish(result, context);
    return result;
}

void name_sphere(const CanonicalMesh& mesh, SphereResult& result)
{
    const Vertices points = std::move(result.points);
    result.points.resize(points.rows(), 3);
    for (Eigen::Index v = 0; v < points.rows(); ++v) result.points.row(mesh.original_vertices[v]) = points.row(v);
    for (SphereLoop& loop : result.loops) {
        mesh.name_loop(loop.vertices);
        mesh.name_vertices(loop.off_circle);
    }
    for (auto* faces :
         {&result.flipped_on_sphere, &result.below_sphere_resolution, &result.layout.crossing, &result.layout.moved,
          &result.layout.torn, &result.layout.flipped, &result.layout.below_resolution})
        mesh.name_faces(*faces);
}

}  // namespace

const char* to_string(SphereLayout layout) noexcept
{
    return word_of(layout, std::array{"equirectangular", "octahedral"});
}

SphereResult sphere_map(const Vertices& vertices, const Triangles& triangles, const SphereOptions& options,
                        ExecutionContext& context)
{
    return corner_map<SphereResult>(vertices, triangles, options, context, sphere_map_here, name_sphere);
}

}  // namespace koebe
