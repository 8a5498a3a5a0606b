#include "pipeline/uniformize.h"

#include "circles/boundary_angles.h"
#include "circles/circle_projection.h"
#include "circles/crowded_circles.h"
#include "core/errors.h"
#include "embedding/embedded_map.h"
#include "embedding/fixed_places.h"
#include "execution/detachable_run.h"
#include "execution/peak_memory.h"
#include "execution/stopwatch.h"
#include "execution/thread_share.h"
#include "foldover/angle_polish.h"
#include "linear/dense_spd.h"
#include "pipeline/even_disk.h"
#include "pipeline/final_check.h"
#include "pipeline/flip_removal.h"
#include "pipeline/map_from_loops.h"
#include "pipeline/map_report.h"
#include "pipeline/map_warnings.h"
#include "pipeline/normalization.h"
#include "pipeline/outer_loop.h"
#include "pipeline/problem.h"
#include "quality/shared_warnings.h"
#include "quality/take_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

/// Least angles between the vertices of the outer loop. Three neighbours s apart make a face s^2 / 2 high, which 32-bit
/// UVs must tell from 0.
VectorXd least_steps(Eigen::Index count)
{
    constexpr double drawable = 2e-3;  // radians
    return VectorXd::Constant(count, std::min(drawable, 0.3 * 2.0 * std::numbers::pi / static_cast<double>(count)));
}

/// Factors, iterates and makes the map, if there is one.
/// @param from, until the range of the progress
std::optional<CircleMap> iterate(Problem& problem, const UniformizeOptions& options, double from, double until,
                                 ExecutionContext& context, Stopwatch& stage, StageSeconds& seconds)
{
    const auto at = [&](double share) { return from + share * (until - from); };
    if (!problem.assembled.factored) {
        context.begin_stage("factor", at(0.0), at(0.45));
        try {
            problem.assembled.factorize(problem.input(), options);
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {  // the map is made without a factor, and warns
        }
    }
    seconds.factor += stage.lap();
    context.begin_stage("iterate", at(0.45), at(0.95));
    problem.outcome = loop_images(problem.input(), problem.assembled, options, context, &problem.outcome);
    seconds.iterate += stage.lap();
    context.begin_stage("finish", at(0.95), at(1.0));
    if (!problem.assembled.factored || problem.outcome.loops.empty()) return {};
    std::optional<CircleMap> map = map_from_loops(problem.solver(), problem.cut, problem.outcome);
    if (map) lay_over_first(problem, *map);
    return map;
}

/// Makes the map that is one to one from the start (embedded_map), on the iteration's circles if it found any.
/// @param failed the map from the iteration, if any
CircleMap embed(const MapInput& whole, const FlapCut& cut, const std::optional<CircleMap>& failed, FixedPlaces places,
                ExecutionContext& context)
{
    const VectorXcd even = unit_circle_points(arc_length_angles(whole.edges[0]));
    VectorXcd rim = even;
    if (failed)
        for (Eigen::Index i = 0; i < rim.size(); ++i) {
            const Index v = whole.loops[0][i];
            rim[i] = {failed->uv(v, 0), failed->uv(v, 1)};
        }
    rim = project_onto_circle(Circle{}, rim.allFinite() ? rim : even, 1, least_steps(whole.edges[0].size()));
    CircleMap map = embedded_map(whole.vertices, whole.surface, whole.loops, cut.flaps,
                                 failed && circles_apart(failed->circles) ? failed->circles : std::vector<Circle>{},
                                 rim, context, places);
    if (!failed) return map;
    map.roundness = failed->roundness;
    map.shrunk = failed->shrunk;
    map.lost = failed->lost;
    for (std::size_t k = 0; k < map.circles.size(); ++k)
        if (failed->circles[k].center != map.circles[k].center || failed->circles[k].radius != map.circles[k].radius)
            map.replaced.push_back(static_cast<Index>(k));
    return map;
}

/// Polishes the map. Takes the polish back if the map then has a fault, though the polish checks its own steps.
void polish(const MapInput& whole, CircleMap& map, MapFaults& faults, ExecutionContext& context)
{
    PlanarPoints before = map.uv;
    polish_angles(whole.vertices, whole.surface, whole.loops, map.circles, map.off_circle, map.uv, context,
                  held_vertices(whole));
    MapFaults polished = find_faults(whole.surface.triangles, whole.loops, map.uv, map.circles);
    if (polished.any() && !faults.any())
        map.uv = std::move(before);
    else
        faults = std::move(polished);
}

/// The image of each step on the input's vertices.
std::vector<PlanarPoints> on_input(const std::vector<VectorXcd>& images, const MapInput& input, Index vertex_count)
{
    std::vector<PlanarPoints> result;
    for (const VectorXcd& image : images) {
        result.push_back(PlanarPoints::Constant(vertex_count, 2, std::numeric_limits<double>::quiet_NaN()));
        for (Eigen::Index v = 0; v < image.size(); ++v)
            if (std::isfinite(std::norm(image[v])))
                result.back().row(input.original[v]) << image[v].real(), image[v].imag();
    }
    return result;
}

void append(std::vector<Warning>& warnings, std::vector<Warning> more)
{
    std::move(more.begin(), more.end(), std::back_inserter(warnings));
}

/// Replaces numbers in a piece by the whole surface's numbers.
void rename(std::vector<Index>& numbers, const std::vector<Index>& names)
{
    for (Index& number : numbers) number = names.at(static_cast<std::size_t>(number));
}

}  // namespace

UniformizeResult map_problem(const Vertices& vertices, const Triangles& triangles,
                             const std::function<Problem&()>& prepare, const UniformizeOptions& options,
                             ExecutionContext& context)
{
    UniformizeResult result;
    require_even_disk(options.even, options.center);
    result.even = 0.0;  // a value for maps that are not made more even below
    result.method = options.method;
    result.engine = options.engine;
    result.center = options.center;
    result.point = options.point;
    fix_product_blocks();
    const ThreadShare threads(options.threads);
    Stopwatch total, stage;

    context.begin_stage("topology", 0.0, 0.05);
    Problem& problem = prepare();
    const MapInput& whole = problem.whole;
    result.vertex_count = problem.vertex_count;
    result.face_count = static_cast<Index>(whole.surface.triangles.rows());
    result.seconds.topology = stage.lap();

    context.begin_stage("metric", 0.05, 0.15);
    problem.assembled.take_metric(problem.input());
    result.seconds.metric = stage.lap();

    // If the outer loop must be chosen, the map may be made twice, first with the longest loop.
    const bool choose = chooses_outer_loop(options, whole);
    std::optional<CircleMap> map = iterate(problem, options, 0.15, choose ? 0.5 : 0.9, context, stage, result.seconds);
    if (map && options.balance == Balance::area)
        result.unbalanced_area =
            measure_distortion(whole.vertices, whole.surface.triangles, hang_back(whole, problem.cut, *map, context).uv)
                .area;
    if (map && choose)
        if (const int outer = better_outer_loop(problem.input(), *map); outer != 0) {
            put_outside(outer, problem.whole, problem.cut, problem.core);
            problem.assembled.reorder(problem.input());
            result.seconds.finish += stage.lap();
            map = iterate(problem, options, 0.5, 0.9, context, stage, result.seconds);
        }
    if (map && options.balance == Balance::area) map = with_area_balanced(problem.solver(), *map);
    if (map && whole.center >= 0) map = with_center_moved(problem.solver(), whole, problem.cut, *map, context);
    result.outer_loop = whole.outer_rank;
    result.converged = problem.outcome.converged && map.has_value();
    result.sweeps = problem.outcome.sweeps;
    result.steps = problem.outcome.steps;
    result.history = problem.outcome.history;
    result.step_images = on_input(problem.outcome.step_images, problem.input(), result.vertex_count);

    context.begin_stage("finish", 0.9, 1.0);
    UntangleReport untangled;
    MapFaults faults;
    if (map) {
        map = hang_back(whole, problem.cut, std::move(*map), context);
        put_in_place(whole, *map);
        context.advance(0.2);
        if (options.repair) untangled = remove_flips(whole, *map, context);
        context.advance(0.5);
        if (options.repair) faults = find_faults(whole.surface.triangles, whole.loops, map->uv, map->circles);
    }
    const bool no_circles = !map;
    bool out_of_place = false;
    if (!map || faults.any()) {
        const std::optional<CircleMap> failed = std::move(map);
        map = embed(whole, problem.cut, failed, {whole.center, whole.point}, context);
        put_in_place(whole, *map);
        untangled = {};
        faults = find_faults(whole.surface.triangles, whole.loops, map->uv, map->circles);
        if (faults.any() && whole.center >= 0) {  // one to one is more important
            CircleMap elsewhere = embed(whole, problem.cut, failed, {-1, whole.point}, context);
            if (MapFaults none = find_faults(whole.surface.triangles, whole.loops, elsewhere.uv, elsewhere.circles);
                !none.any()) {
                map = std::move(elsewhere);
                faults = std::move(none);
                out_of_place = true;
            }
        }
    }
    if (options.polish) {
        context.begin_stage("polish", 0.97, 1.0);
        result.unpolished_angle_error_deg =
            measure_distortion(whole.vertices, whole.surface.triangles, map->uv).angle_error_deg;
        polish(whole, *map, faults, context);
    }
    bool not_even = false;
    std::optional<ConformalDomain> conformal;
    if (options.even > 0.0) {
        context.begin_stage("even", 0.98, 1.0);
        conformal = domain_of(whole, *map, result.vertex_count);
        not_even = faults.any() || !make_disk_even(whole, options.even, options.loops, *map, context);
        result.even = not_even ? 0.0 : options.even;
    }
    report_map(vertices, triangles, whole, *map, result);
    if (conformal && !not_even) keep_conformal(std::move(*conformal), result);
    if (!options.vertex_names.empty()) rename(problem.whole.original, options.vertex_names);
    if (!options.face_names.empty()) rename(problem.whole.original_faces, options.face_names);
    append(result.warnings, circle_warnings(*map));
    append(result.warnings, input_warnings(whole));
    append(result.warnings, iteration_warnings(problem.outcome, no_circles));
    append(result.warnings, flip_warnings(whole, map->uv, problem.cut.flaps, untangled, result.distortion));
    if (out_of_place) {
        result.converged = false;
        result.warnings.push_back({WarningKind::out_of_place,
                                   "the vertex could not be moved to the centre without turning faces over",
                                   {options.center}});
    }
    if (not_even) warn_not_even({}, result.warnings);
    result.overlaps = static_cast<Index>(faults.crossings.size());
    if (faults.any()) {
        result.converged = false;
        result.warnings.push_back(
            faults.warning("no one-to-one map was found: ", whole.original, whole.original_faces));
    }
    take_verdict({.most_lost = options.most_lost, .done = true}, result);
    result.seconds.finish += stage.lap();
    result.seconds.total = total.lap();
    result.peak_memory_mb = peak_memory_mb();
    context.advance(1.0);
    return result;
}

UniformizeResult uniformize_here(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options,
                                 ExecutionContext& context)
{
    Problem problem;
    return map_problem(
        vertices, triangles, [&]() -> Problem& { return problem = prepare_problem(vertices, triangles, options); },
        options, context);
}

UniformizeResult uniformize(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options,
                            ExecutionContext& context)
{
    return run_detachable<UniformizeResult>(context, [vertices, triangles, options](ExecutionContext& own) {
        return uniformize_here(vertices, triangles, options, own);
    });
}

UniformizeResult uniformize(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    ExecutionContext context;
    return uniformize(vertices, triangles, options, context);
}

}  // namespace koebe
