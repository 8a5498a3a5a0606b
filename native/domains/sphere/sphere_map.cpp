#include "sphere/sphere_map.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/enum_words.h"
#include "core/errors.h"
#include "core/sort_unique.h"
#include "core/types.h"
#include "even/even_map.h"
#include "even/wanted_shapes.h"
#include "execution/each_in_pieces.h"
#include "execution/execution.h"
#include "foldover/convex_polygons.h"
#include "linear/dense_spd.h"
#include "pipeline/uniformize.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/take_verdict.h"
#include "sphere/elastic_sphere.h"
#include "sphere/plane_map.h"
#include "sphere/sphere_check.h"
#include "sphere/sphere_layout.h"
#include "sphere/sphere_repair.h"
#include "sphere/spherical_balance.h"
#include "surface/laplacian.h"
#include "surface/periodic_surface.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// Faces of a surface that may be drawn together, or opened at a vertex, at most.
constexpr Index most_drawn_faces = 5000;

constexpr double least_angle = 1e-7;           // between neighbours on a circle, seen from its middle
constexpr std::size_t further_effort = 30000;  // of the repair of each further version (sphere_repair.h)

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

/// Lifts a map to the sphere by stereographic projection, with loops on the circles of their caps, and ears of the
/// outer loop in its cap. Balances it without flipping faces. A balanced surface of few faces may need faces of half
/// the sphere. It is drawn together round the middle of the outer circle's other side instead, where no such face is
/// needed.
/// @param balance of the map (balance_on_sphere) @param drawn out: whether it is drawn together
/// @throws Cancelled
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

constexpr double nearest_size = 8.0;  // most ratio of the area that a face wants next to its present area,
constexpr double few_far_off = 1e-3;  // until sizes differ by more only on this share of the area
constexpr int most_approaches = 30;
constexpr int steps_an_approach = 4;
constexpr int last_steps = 60;
constexpr double settled_fall = 5e-4;   // relative decrease of the energy
constexpr double lightest_face = 1e-3;  // weight of a face, over the mean

/// Minimizes E_t of even/even_map.h, from the surface's faces to the flat faces on the sphere
/// (sphere/elastic_sphere.h). The surface is scaled to the area of the map. At first sizes are wanted that are near the
/// present ones (Liu, Ye, Ni and Fu 2018). Vertices of loops stay.
/// @param points (V, 3) unit vectors @param even E, above 0 to 1
/// @return false, with the points as they were, if the map has faces that are not upright, or none that moves
/// @throws Cancelled
bool make_sphere_even(const PeriodicSurface& domain, double even, Vertices& points, const ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    if (!all_upright(triangles, points)) return false;
    // The surface, scaled to the area that the faces cover on the sphere, and its faces laid flat.
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
    // Sizes within a factor of the present ones are wanted first, until few faces are farther off.
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
    // Then the surface's own sizes.
    sphere.reference = shapes.references;
    steps += relax_on_sphere(sphere, points, last_steps, settled_fall, factor, context).steps;
    return steps > 0;
}

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

/// For coarse surfaces where closed_sphere.h turns faces over. The faces round a vertex are removed. `uniformize` maps
/// the rest to the disk, one to one in 32-bit UVs. The vertex goes to the middle of the remaining cap. Tries some
/// vertices, those with the largest faces on the sphere, each balanced and drawn to half the sphere.
/// @param domain closed @param weights (V) area around each vertex @param points (V, 3) the map with flipped faces
/// @return a one-to-one map, or nothing
/// @throws Cancelled
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
    std::vector<Index> result;
    for (const Index v : vertices) result.push_back(domain.original[v]);
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
    std::vector<Index> unused(static_cast<std::size_t>(result.vertex_count));
    std::iota(unused.begin(), unused.end(), 0);
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
