#include "sphere/sphere_map.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/enum_words.h"
#include "core/sort_unique.h"
#include "even/even_map.h"
#include "execution/each_in_pieces.h"
#include "flaps/flaps.h"
#include "linear/dense_spd.h"
#include "mesh/loop_with.h"
#include "pipeline/loop_numbers.h"
#include "pipeline/uniformize.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/take_verdict.h"
#include "sphere/closed_sphere.h"
#include "sphere/even_sphere.h"
#include "sphere/opened_sphere.h"
#include "sphere/sphere_check.h"
#include "sphere/sphere_layout.h"
#include "sphere/sphere_repair.h"
#include "sphere/spherical_balance.h"
#include "surface/laplacian.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double least_angle = 1e-7;      // between neighbours on a circle, seen from its middle
constexpr Index most_drawn_faces = 5000;  // of a surface that may be drawn together

/// A map to the plane and the point at infinity, and its data.
struct PlaneMap {
    VectorXcd z;                       // (V) of the domain's vertices
    std::vector<Circle> circles;       // of the domain's loops; the outer circle stands for its outside
    std::vector<Roundness> roundness;  // of the loops
    std::vector<Index> off_circle;     // of the domain, ascending
    std::size_t outer = 0;             // number of the outer loop
    std::vector<Flap> flaps;           // flaps on the outer loop
    bool converged = false;
    int sweeps = 0;
    std::vector<double> changes;
    StageSeconds seconds;
    std::vector<Warning> warnings;  // with the input's vertices and the domain's loops
};

PlaneMap holed_plane_map(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                         const SphereOptions& options, ExecutionContext& context)
{
    UniformizeOptions map_options;
    map_options.outer = OuterLoop::longest;
    map_options.threads = options.threads;
    static_cast<SweepOptions&>(map_options) = options;
    map_options.most_lost = 1.0;  // the sphere has its own verdict
    const UniformizeResult disk = uniformize_here(vertices, triangles, map_options, context);
    PlaneMap map;
    map.z.resize(domain.surface.vertex_count);
    std::vector<Index> number(static_cast<std::size_t>(vertices.rows()), -1);
    for (Index v = 0; v < domain.surface.vertex_count; ++v) {
        number[domain.original[v]] = v;
        map.z[v] = {disk.uv(domain.original[v], 0), disk.uv(domain.original[v], 1)};
    }
    std::vector<const LoopReport*> report;
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        const int found = loop_with(disk.loops, domain.original[domain.loops[k].front()], &LoopReport::vertices);
        const LoopReport& loop = disk.loops.at(found);
        if (found == 0) map.outer = k;
        report.push_back(&loop);
        map.circles.push_back(loop.circle);
        map.roundness.push_back(loop.roundness);
        for (const Index v : loop.off_circle) map.off_circle.push_back(number[v]);
    }
    std::ranges::sort(map.off_circle);
    for (Flap& flap : cut_flaps(domain.vertices, domain.surface, domain.loops).flaps)
        if (flap.loop == static_cast<int>(map.outer)) map.flaps.push_back(std::move(flap));
    map.converged = disk.converged;
    map.sweeps = disk.sweeps;
    map.seconds = disk.seconds;
    for (const KoebeStep& step : disk.history) map.changes.push_back(step.change);
    map.warnings =
        with_loops_renumbered(disk, report,
                              {WarningKind::below_resolution, WarningKind::flipped, WarningKind::not_one_to_one,
                               WarningKind::reoriented_faces, WarningKind::off_circle, WarningKind::unused_vertices,
                               WarningKind::coarse_mesh});
    return map;
}

/// Hangs a flap into its hole, mirrored at its hinge. In the disk the unit circle is convex, and the flap lies behind
/// its hinge; on the sphere it would lie over its neighbours.
void hang_into_hole(const PeriodicSurface& domain, const Flap& flap, SphericalMap& sphere)
{
    const Triangles& triangles = domain.surface.triangles;
    std::size_t flipped = 0;
    for (const Index f : flap.faces) flipped += upright_on_sphere(triangles, sphere.points, f) ? 0 : 1;
    const SpherePoint normal =
        SpherePoint(sphere.points.row(flap.first)).cross(SpherePoint(sphere.points.row(flap.last)));
    if (2 * flipped <= flap.faces.size() || !(normal.norm() > 0.0)) return;
    const Eigen::RowVector3d across = normal.normalized().transpose();
    for (const auto* vertices : {&flap.rim, &flap.interior})
        for (const Index v : *vertices) {
            const Eigen::RowVector3d at = sphere.points.row(v);
            sphere.points.row(v) = (at - 2.0 * at.dot(across) * across).normalized();
        }
    sphere.off_circle.insert(sphere.off_circle.end(), flap.rim.begin(), flap.rim.end());
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
    for (const Flap& flap : map.flaps) hang_into_hole(domain, flap, sphere);
    sort_unique(sphere.off_circle);
    return sphere;
}

/// Balances a map without flipping faces. A balanced surface of few faces may need faces of half the sphere. It is
/// drawn together round the middle of the outer circle's other side instead, where no such face is needed.
SphericalMap drawn_together(const PeriodicSurface& domain, const PlaneMap& map, const PlaneSimilarity& balance,
                            bool& drawn, const ExecutionContext& context)
{
    const auto drawn_by = [&](double farther, bool repair) {
        SphericalMap sphere = lifted_to_sphere(domain, map, {balance.shift, balance.scale * std::exp(farther)});
        if (repair) turn_back_on_sphere(domain, sphere, context);
        return sphere;
    };
    const auto whole = [&](const SphericalMap& sphere) {
        return !find_sphere_faults(domain.surface.triangles, domain.loops, sphere.points, sphere.caps).any();
    };
    SphericalMap balanced = drawn_by(0.0, true);
    drawn = false;
    if (domain.loops.empty() || domain.surface.triangles.rows() > most_drawn_faces || whole(balanced)) return balanced;
    for (const bool repair : {false, true})
        for (const double farther : {0.01, 0.04, 0.16, 0.64, 2.56}) {
            if (repair && farther < 0.1) continue;
            SphericalMap sphere = drawn_by(farther, repair);
            if (!whole(sphere)) continue;
            drawn = true;
            return sphere;
        }
    return balanced;
}

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

void warn_of_sphere(const PeriodicSurface& domain, const PlaneMap& map, const SphericalMap& sphere,
                    const SphereFaults& faults, bool balanced, bool drawn, bool opened, SphereResult& result)
{
    result.warnings = map.warnings;
    warn_reoriented(domain.surface.reoriented, result.warnings);
    std::vector<Index> unused(static_cast<std::size_t>(result.vertex_count));
    std::iota(unused.begin(), unused.end(), 0);
    std::erase_if(unused, [&](Index v) { return std::ranges::binary_search(domain.original, v); });
    if (!unused.empty())
        result.warnings.push_back({WarningKind::unused_vertices,
                                   counted(unused.size(), "vertex") + " without a face, put at (0, 0, 1)",
                                   std::move(unused)});
    if (domain.loops.empty() && !map.converged)
        result.warnings.push_back({WarningKind::not_converged, "the iteration ended before it reached its tolerance"});
    if (drawn)
        result.warnings.push_back(
            {WarningKind::coarse_mesh, "too few faces to spread them evenly over the sphere: they lie close together"});
    else if (opened)
        result.warnings.push_back(
            {WarningKind::coarse_mesh, "faces of the balanced map turn over: a map opened at a vertex replaces it"});
    else if (!balanced)
        result.warnings.push_back({WarningKind::not_converged,
                                   "no even spread over the sphere was found: half of the surface shrinks to a point"});
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
    std::vector<Index> turned_over, tiny;
    std::ranges::set_difference(result.layout.flipped, result.layout.torn, std::back_inserter(turned_over));
    std::ranges::set_intersection(turned_over, result.layout.below_resolution, std::back_inserter(tiny));
    if (!turned_over.empty())
        result.warnings.push_back({WarningKind::flipped,
                                   counted(turned_over.size(), "face") + " flipped in the UVs, " +
                                       std::to_string(tiny.size()) + " of them too small for 32-bit UVs",
                                   turned_over});
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
    PlaneMap map;
    if (domain.loops.empty()) {
        IterationOptions iteration;
        static_cast<SweepOptions&>(iteration) = options;
        ClosedSphereMap closed = closed_sphere_map(domain, weights, iteration, context);
        map.z = std::move(closed.z);
        map.converged = closed.converged;
        map.changes = std::move(closed.changes);
        map.seconds = closed.seconds;
        map.sweeps = static_cast<int>(map.changes.size());
    } else {
        ExecutionContext own([&](double done, const std::string& name) { context.report(0.1 + 0.7 * done, name); }, {},
                             [&] { context.checkpoint(); });
        map = holed_plane_map(vertices, triangles, domain, options, own);
    }
    clock.take(map.seconds);

    context.begin_stage("finish", 0.8, 1.0);
    const SphericalBalance balance = balance_on_sphere(map.z, weights);
    bool drawn = false;
    SphericalMap sphere = drawn_together(domain, map, balance.move, drawn, context);
    bool opened = false;
    if (domain.loops.empty() && domain.surface.triangles.rows() <= most_drawn_faces &&
        find_sphere_faults(domain.surface.triangles, {}, sphere.points, {}).any())
        if (auto other = opened_at_a_vertex(domain, weights, sphere.points, context)) {
            sphere = std::move(*other);
            opened = true;
        }
    result.even =
        options.even > 0.0 && make_sphere_even(domain, options.even, sphere.points, context) ? options.even : 0.0;
    const Eigen::Matrix3d turn = mesh.turn * best_rotation(sphere.points, directions_of(domain, weights), weights);
    each_in_pieces(sphere.points.rows(), [&](Eigen::Index v) {
        sphere.points.row(v) = (turn * sphere.points.row(v).transpose()).normalized().transpose();
    });
    for (Cap& cap : sphere.caps) cap.center = (turn * cap.center).normalized();
    turn_back_on_sphere(domain, sphere, context);  // for faces that rounding after the rotation has turned over
    result.mean_point = (weights.transpose() * sphere.points).norm() / weights.sum();

    const SphereFaults faults = find_sphere_faults(domain.surface.triangles, domain.loops, sphere.points, sphere.caps);
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    result.points = Vertices::Zero(vertices.rows(), 3);
    result.points.col(2).setOnes();
    for (Index v = 0; v < domain.surface.vertex_count; ++v)
        result.points.row(domain.original[v]) = sphere.points.row(v);
    result.turned = domain.surface.reoriented;
    std::vector<char> turned(static_cast<std::size_t>(triangles.rows()), 0);
    for (const Index f : result.turned) turned[f] = 1;
    result.uv = sphere_layout(triangles, result.points, turned, options.polygon, options.layout, result.layout);
    result.loops = loops_on_sphere(domain, map, sphere);
    result.distortion = {distortion_on_sphere(domain, sphere.points),
                         judge_corners(vertices, triangles, result.uv, result.turned)};
    result.layout.kind = options.layout;
    result.layout.flipped = result.distortion.flipped;
    result.layout.below_resolution = result.distortion.below_resolution;
    result.flipped_on_sphere = faults.flipped;
    result.below_sphere_resolution = faults.below_resolution;
    result.converged = map.converged && !faults.any() && (balance.balanced || drawn || opened);
    result.sweeps = map.sweeps;
    result.changes = map.changes;
    warn_of_sphere(domain, map, sphere, faults, balance.balanced, drawn, opened, result);
    if (*result.even < options.even) warn_not_even({}, result.warnings);
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
    for (auto* faces : {&result.flipped_on_sphere, &result.below_sphere_resolution, &result.layout.crossing,
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
