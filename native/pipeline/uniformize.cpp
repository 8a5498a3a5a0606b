#include "pipeline/uniformize.h"

#include "conformal/boundary_angles.h"
#include "conformal/circle_fit.h"
#include "conformal/distortion.h"
#include "conformal/circle_projection.h"
#include "core/detachable_run.h"
#include "core/peak_memory.h"
#include "core/topology.h"
#include "core/errors.h"
#include "core/memory_limit.h"
#include "foldover/angle_polish.h"
#include "foldover/embedded_map.h"
#include "foldover/flip_removal.h"
#include "foldover/flip_report.h"
#include "geometry/dense_spd.h"
#include "pipeline/domain.h"
#include "pipeline/loop_images.h"
#include "pipeline/placement.h"
#include "pipeline/promise.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <optional>
#include <string>

namespace koebe {
namespace {

constexpr double delicate = 1e4;          // least height of a face in steps of the grid, for the grid not to show
constexpr double bytes_per_face = 900.0;  // of everything but the factor; measured on 0.1 to 2.6 million faces

class Stopwatch {
public:
    /// Seconds since the last lap.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Least angles between the vertices of the outer loop: three neighbours s apart make a face s^2 / 2 high, which 32-bit
/// UVs must tell from none.
VectorXd least_steps(Eigen::Index count)
{
    constexpr double drawable = 2e-3;  // radians
    return VectorXd::Constant(count, std::min(drawable, 0.3 * 2.0 * std::numbers::pi / static_cast<double>(count)));
}

void add_warnings(const Domain& domain, const KoebeOutcome& outcome, UniformizeResult& result)
{
    auto& warnings = result.warnings;
    const auto plural = [](std::size_t n, const std::string& noun) {
        return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
    };
    if (const auto& unused = domain.surface.unused; !unused.empty())
        warnings.push_back({WarningKind::unused_vertices,
                            "vertices of no face, put at the centre: " + std::to_string(unused.size()), unused});
    if (const auto& turned = domain.surface.reoriented; !turned.empty())
        warnings.push_back(
            {WarningKind::reoriented_faces, plural(turned.size(), "face") + " turned to the orientation of the others",
             turned,
             2 * turned.size() == static_cast<std::size_t>(domain.surface.triangles.rows())
                 ? "They are as many as the others: which side is the front follows from the numbers of the faces alone"
                 : ""});
    if (outcome.raised_angles > 0)
        warnings.push_back({WarningKind::no_flux,
                            plural(static_cast<std::size_t>(outcome.raised_angles), "boundary vertex step") +
                                " without flux, kept apart by a least distance"});
    if (domain.thinnest < delicate)
        warnings.push_back({WarningKind::thin_faces,
                            "faces so thin that the last digits of their coordinates show in the map: turned or scaled, "
                            "the surface may get another one"});
    if (!outcome.converged)
        warnings.push_back({WarningKind::not_converged,
                            "not converged in " + plural(static_cast<std::size_t>(outcome.sweeps), "sweep")});
}

/// The map that is one to one from the start (embedded_map), on the circles of the iteration if it has found any.
/// @param failed the map that the iteration led to; null if it led to none @param circles of the loops, in and out
UntangledMap embed(const Domain& whole, const FlapCut& cut, const UntangledMap* failed, std::vector<Circle>& circles,
                   UniformizeResult& result, ExecutionContext& context)
{
    VectorXcd rim = unit_circle_points(arc_length_angles(whole.edges[0]));
    if (failed) {
        for (Eigen::Index i = 0; i < rim.size(); ++i) {
            const Index v = whole.loops[0][i];
            rim[i] = {failed->uv(v, 0), failed->uv(v, 1)};
        }
    } else {
        circles.clear();
        result.converged = false;
        result.warnings.push_back({WarningKind::no_circles,
                                   "the iteration led to no circles: these are such as fit a map of low angle error"});
    }
    if (!rim.allFinite()) rim = unit_circle_points(arc_length_angles(whole.edges[0]));
    rim = project_onto_circle(Circle{}, rim, 1, least_steps(whole.edges[0].size()));
    EmbeddedMap map = embedded_map(whole.vertices, whole.surface, whole.loops, cut.flaps,
                                   failed && circles_apart(circles) ? circles : std::vector<Circle>{}, rim, context);
    circles = map.circles;
    std::vector<Index> others;
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const Circle before = result.loops[k].circle;
        if (before.center != circles[k].center || before.radius != circles[k].radius) {
            others.push_back(static_cast<Index>(k));
            result.loops[k].shrunk = true;
        }
        result.loops[k].circle = circles[k];
        if (!failed) result.loops[k].roundness = map.roundness[k];
    }
    if (failed && !others.empty())
        result.warnings.push_back(
            {WarningKind::replaced_circles,
             "loops on other circles than the iteration's, where on those faces would turn over: " +
                 std::to_string(others.size()),
             others});
    return {std::move(map.uv), std::move(map.off_circle), {}};
}

UniformizeResult run_pipeline(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options,
                              ExecutionContext& context)
{
    UniformizeResult result;
    result.method = options.method;
    result.engine = options.engine;
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    Stopwatch total, stage;

    require_memory(bytes_per_face * static_cast<double>(triangles.rows()), "a mesh of so many faces");
    context.begin_stage("topology", 0.0, 0.05);
    const Domain whole = prepare_domain(vertices, triangles, options);
    // A polygon without inner vertices goes round the circle whole: of equal halves none is the flap.
    FlapCut cut = is_polygon(whole) ? FlapCut{} : cut_flaps(whole.vertices, whole.surface, whole.loops);
    std::optional<Domain> core;
    if (!cut.flaps.empty()) core = core_domain(whole, cut);
    const Domain& domain = core ? *core : whole;
    result.outer_loop = domain.outer_rank;
    result.seconds.topology = stage.lap();

    context.begin_stage("metric", 0.05, 0.15);
    AssembledDomain assembled;
    assembled.take_metric(domain);
    result.seconds.metric = stage.lap();

    context.begin_stage("factor", 0.15, 0.5);
    const SerialDenseKernels serial;
    try {
        assembled.factorize(domain);
    } catch (const OutOfMemory&) {
        throw;
    } catch (const SolverError&) {  // the map is made without it, and says so
    }
    result.seconds.factor = stage.lap();

    context.begin_stage("iterate", 0.5, 0.9);
    const KoebeOutcome outcome = loop_images(domain, assembled, options, context);
    result.converged = outcome.converged;
    result.sweeps = outcome.sweeps;
    result.steps = outcome.steps;
    result.history = outcome.history;
    result.seconds.iterate = stage.lap();

    context.begin_stage("finish", 0.9, 1.0);
    int outer = 0;
    std::optional<PlanarPoints> core_uv;
    if (assembled.condensed && !outcome.loops.empty())
        core_uv = finish_map(*assembled.condensed, assembled.laplacian, domain, cut, outcome, options, result, outer);
    context.advance(0.5);
    if (outer != 0) {
        UniformizeOptions chosen = options;
        chosen.outer = OuterLoop::vertex;
        chosen.outer_vertex = domain.original[domain.loops[outer].front()];
        UniformizeResult better = run_pipeline(vertices, triangles, chosen, context);
        better.unbalanced_area = result.unbalanced_area;
        result.seconds.finish = stage.lap();
        better.seconds += result.seconds;
        better.seconds.total = total.lap();
        return better;
    }
    const NamedSurface named{whole.vertices, whole.surface, whole.loops, whole.original,
                             whole.original_faces, whole.first_corners};
    UntangledMap map;
    std::vector<Circle> circles = reported_circles(result.loops);
    MapFaults faults;
    if (core_uv) {
        map = remove_flips(named, cut, std::move(*core_uv), circles, context);
        faults = find_faults(whole.surface.triangles, whole.loops, map.uv, circles);
    }
    if (!core_uv || faults.any()) {
        result.loops.resize(whole.loops.size());
        map = embed(whole, cut, core_uv ? &map : nullptr, circles, result, context);
        faults = find_faults(whole.surface.triangles, whole.loops, map.uv, circles);
    }
    if (options.polish) {
        context.begin_stage("polish", 0.97, 1.0);
        result.unpolished_angle_error_deg =
            measure_distortion(whole.vertices, whole.surface.triangles, map.uv).angle_error_deg;
        const PlanarPoints before = map.uv;
        polish_angles(whole.vertices, whole.surface, whole.loops, circles, map.off_circle, map.uv, context);
        // It looks after faces and circles; a loop with vertices off its circle may still come to cross itself.
        MapFaults polished = find_faults(whole.surface.triangles, whole.loops, map.uv, circles);
        if (polished.any() && !faults.any())
            map.uv = before;
        else
            faults = std::move(polished);
    }
    report_map(named, map, result);
    add_warnings(whole, outcome, result);
    const auto of_flips = flip_warnings(named, map.uv, cut.flaps, map.report, result.distortion);
    result.warnings.insert(result.warnings.end(), of_flips.begin(), of_flips.end());
    if (faults.any()) {
        result.converged = false;
        result.warnings.push_back(
            faults.warning("no one-to-one map was found: ", whole.original, whole.original_faces));
    }
    result.seconds.finish = stage.lap();
    result.seconds.total = total.lap();
    result.peak_memory_mb = peak_memory_mb();
    context.advance(1.0);
    return result;
}

}  // namespace

UniformizeResult uniformize(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options,
                            ExecutionContext& context)
{
    return run_detachable<UniformizeResult>(context, [vertices, triangles, options](ExecutionContext& own) {
        return run_pipeline(vertices, triangles, options, own);
    });
}

}  // namespace koebe
