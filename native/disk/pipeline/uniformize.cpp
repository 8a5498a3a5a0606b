#include "pipeline/uniformize.h"

#include "circles/boundary_angles.h"
#include "circles/circle_projection.h"
#include "circles/crowded_circles.h"
#include "core/errors.h"
#include "embedding/embedded_map.h"
#include "embedding/fixed_places.h"
#include "execution/peak_memory.h"
#include "execution/run_on_copies.h"
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

/// Makes the map that is one to one from the start (embedded_map), on the iteration's circles if it found any.
/// @param failed the map from the iteration, if any
CircleMap embed(const MapInput& whole, const EarCut& cut, const std::optional<CircleMap>& failed, FixedPlaces places,
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
    CircleMap map = embedded_map(whole.vertices, whole.surface, whole.loops, cut.ears,
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

/// A run of map_problem. Each stage takes the state of the stages before it.
class MapRun {
public:
    MapRun(const UniformizeOptions& options, ExecutionContext& context);

    void prepare(const std::function<Problem&()>& prepare);
    void take_metric();
    void map_core();
    void change_outer_loop();
    void normalize_core();
    void attach_ears();
    void remove_flips();
    void mend_where_it_failed();
    void embed_where_it_failed();
    void polish();
    void make_even();
    UniformizeResult report(const Vertices& vertices, const Triangles& triangles);

private:
    const MapInput& whole() const { return problem_->whole; }
    void map_core(double from, double until);
    void factorize();
    MapFaults faults_of(const CircleMap& map) const
    {
        return find_faults(whole().surface.triangles, whole().loops, map.uv, map.circles);
    }

    const UniformizeOptions& options_;
    ExecutionContext& context_;
    Stopwatch total_, stage_;
    Problem* problem_ = nullptr;
    std::optional<CircleMap> map_;  // of the core up to attach_ears, then of the whole surface
    MapFaults faults_;              // of the map of the whole surface
    UntangleReport untangled_;
    std::vector<Warning> iteration_warnings_, late_warnings_;
    std::optional<ConformalDomain> conformal_;  // before the map was made more even
    UniformizeResult result_;
};

MapRun::MapRun(const UniformizeOptions& options, ExecutionContext& context) : options_(options), context_(context)
{
    require_even_disk(options.even, options.center);
    result_.even = 0.0;
    result_.method = options.method;
    result_.engine = options.engine;
    result_.center = options.center;
    result_.point = options.point;
}

void MapRun::prepare(const std::function<Problem&()>& prepare)
{
    context_.begin_stage("topology", 0.0, 0.05);
    problem_ = &prepare();
    result_.vertex_count = problem_->vertex_count;
    result_.face_count = static_cast<Index>(whole().surface.triangles.rows());
    result_.seconds.topology = stage_.lap();
}

void MapRun::take_metric()
{
    context_.begin_stage("metric", 0.05, 0.15);
    problem_->assembled.take_metric(problem_->input());
    result_.seconds.metric = stage_.lap();
}

void MapRun::map_core()
{
    const bool again = chooses_outer_loop(options_, whole());
    map_core(0.15, again ? 0.5 : 0.9);
    if (map_ && options_.balance == Balance::area)
        result_.unbalanced_area = measure_distortion(whole().vertices, whole().surface.triangles,
                                                     with_ears(whole(), problem_->cut, *map_, context_).uv)
                                      .area;
}

void MapRun::map_core(double from, double until)
{
    const auto at = [&](double share) { return from + share * (until - from); };
    Problem& problem = *problem_;
    AssembledInput& assembled = problem.assembled;
    // K + diag(0, 1 on B) = L L', which gives Sigma = K_BB - K_BI K_II^-1 K_IB. The surface may have it already.
    if (!assembled.factored) {
        context_.begin_stage("factor", at(0.0), at(0.45));
        factorize();
    }
    result_.seconds.factor += stage_.lap();
    // Koebe's iteration: one angle for each boundary vertex, and from the angles the images of the loops.
    context_.begin_stage("iterate", at(0.45), at(0.95));
    problem.outcome = loop_images(problem.input(), assembled, options_, context_, &problem.outcome);
    result_.seconds.iterate += stage_.lap();
    // Circles, and K_II z_I = -K_IB z_B inside.
    context_.begin_stage("finish", at(0.95), at(1.0));
    map_.reset();
    if (!assembled.factored || problem.outcome.loops.empty()) return;
    map_ = map_from_loops(problem.solver(), problem.cut, problem.outcome);
    if (map_) align_with_first(problem, *map_);
}

/// Without a factor there is no map of the core, and embed_where_it_failed makes the map.
void MapRun::factorize()
{
    try {
        problem_->assembled.factorize(problem_->input(), options_);
    } catch (const OutOfMemory&) {
        throw;
    } catch (const SolverError&) {
    }
}

void MapRun::change_outer_loop()
{
    if (!map_ || !chooses_outer_loop(options_, whole())) return;
    const int outer = better_outer_loop(problem_->input(), *map_);
    if (outer == 0) return;
    put_outside(outer, problem_->whole, problem_->cut, problem_->core);
    problem_->assembled.reorder(problem_->input());
    result_.seconds.finish += stage_.lap();
    map_core(0.5, 0.9);
}

void MapRun::normalize_core()
{
    if (map_ && options_.balance == Balance::area) map_ = with_area_balanced(problem_->solver(), *map_);
    if (map_ && whole().center >= 0)
        map_ = with_center_moved(problem_->solver(), whole(), problem_->cut, *map_, context_);
    // The iteration and its map end here.
    const KoebeOutcome& outcome = problem_->outcome;
    iteration_warnings_ = iteration_warnings(outcome, !map_);
    result_.outer_loop = whole().outer_rank;
    result_.converged = outcome.converged && map_.has_value();
    result_.sweeps = outcome.sweeps;
    result_.steps = outcome.steps;
    result_.history = outcome.history;
    result_.step_images = on_input(outcome.step_images, problem_->input(), result_.vertex_count);
}

void MapRun::attach_ears()
{
    context_.begin_stage("finish", 0.9, 1.0);
    if (!map_) return;
    map_ = with_ears(whole(), problem_->cut, *std::move(map_), context_);
    normalize(whole(), *map_);
    context_.advance(0.2);
}

void MapRun::remove_flips()
{
    if (!map_) return;
    if (options_.repair) untangled_ = koebe::remove_flips(whole(), *map_, context_);
    context_.advance(0.5);
    if (options_.repair) faults_ = faults_of(*map_);
}

/// Replaces the map around its wrong faces, if they are few.
void MapRun::mend_where_it_failed()
{
    if (!map_ || !faults_.any() || !circles_apart(map_->circles)) return;
    std::optional<CircleMap> mended = mended_map(whole().vertices, whole().surface, whole().loops, problem_->cut.ears,
                                                 *map_, context_, {whole().center, whole().point});
    if (!mended || faults_of(*mended).any()) return;
    map_ = std::move(mended);
    faults_ = {};
    untangled_ = {};
}

void MapRun::embed_where_it_failed()
{
    if (map_ && !faults_.any()) return;
    const std::optional<CircleMap> failed = std::move(map_);
    map_ = embed(whole(), problem_->cut, failed, {whole().center, whole().point}, context_);
    normalize(whole(), *map_);
    untangled_ = {};
    faults_ = faults_of(*map_);
    if (!faults_.any() || whole().center < 0) return;
    // The vertex at 0 can be what turns faces over. One to one is more important.
    CircleMap elsewhere = embed(whole(), problem_->cut, failed, {-1, whole().point}, context_);
    MapFaults faults = faults_of(elsewhere);
    if (faults.any()) return;
    map_ = std::move(elsewhere);
    faults_ = std::move(faults);
    result_.converged = false;
    late_warnings_.push_back({WarningKind::out_of_place,
                              "the vertex could not be moved to the centre without turning faces over",
                              {options_.center}});
}

/// Takes the polish back if the map then has a fault, though the polish checks its own steps.
void MapRun::polish()
{
    if (!options_.polish) return;
    context_.begin_stage("polish", 0.97, 1.0);
    const Triangles& triangles = whole().surface.triangles;
    result_.unpolished_angle_error_deg = measure_distortion(whole().vertices, triangles, map_->uv).angle_error_deg;
    PlanarPoints before = map_->uv;
    polish_angles(whole().vertices, whole().surface, whole().loops, map_->circles, map_->off_circle, map_->uv, context_,
                  held_vertices(whole()));
    MapFaults polished = faults_of(*map_);
    if (polished.any() && !faults_.any())
        map_->uv = std::move(before);
    else
        faults_ = std::move(polished);
}

void MapRun::make_even()
{
    if (!(options_.even > 0.0)) return;
    context_.begin_stage("even", 0.98, 1.0);
    ConformalDomain conformal = domain_of(whole(), *map_, result_.vertex_count);
    if (faults_.any() || !make_disk_even(whole(), options_.even, options_.loops, *map_, context_))
        return warn_not_even({}, late_warnings_);
    result_.even = options_.even;
    conformal_ = std::move(conformal);
}

UniformizeResult MapRun::report(const Vertices& vertices, const Triangles& triangles)
{
    // The map in the input's numbers, with what can be measured on it.
    report_map(vertices, triangles, whole(), *map_, result_);
    if (conformal_) keep_conformal(*std::move(conformal_), result_);
    if (!options_.vertex_names.empty()) rename(problem_->whole.original, options_.vertex_names);
    if (!options_.face_names.empty()) rename(problem_->whole.original_faces, options_.face_names);
    // Warnings in the order of the stages, and last that the map is not one to one.
    append(result_.warnings, circle_warnings(*map_));
    append(result_.warnings, input_warnings(whole()));
    append(result_.warnings, std::move(iteration_warnings_));
    append(result_.warnings, flip_warnings(whole(), map_->uv, problem_->cut.ears, untangled_, result_.distortion));
    append(result_.warnings, std::move(late_warnings_));
    result_.overlaps = static_cast<Index>(faults_.crossings.size());
    if (faults_.any()) {
        result_.converged = false;
        result_.warnings.push_back(
            faults_.warning("no one-to-one map was found: ", whole().original, whole().original_faces));
    }
    take_verdict({.most_lost = options_.most_lost, .done = true}, result_);
    result_.seconds.finish += stage_.lap();
    result_.seconds.total = total_.lap();
    result_.peak_memory_mb = peak_memory_mb();
    context_.advance(1.0);
    return std::move(result_);
}

}  // namespace

UniformizeResult map_problem(const Vertices& vertices, const Triangles& triangles,
                             const std::function<Problem&()>& prepare, const UniformizeOptions& options,
                             ExecutionContext& context)
{
    fix_product_blocks();
    const ThreadShare threads(options.threads);
    MapRun run(options, context);
    run.prepare(prepare);         // S of genus 0, the loops g_0 ... g_n in the order of the iteration, ears cut off
    run.take_metric();            // K, the cotan Laplacian: u' K u = integral of |grad u|^2 (section 4.1)
    run.map_core();               // Sigma, Koebe's iteration (sections 4.2 to 4.4), circles, harmonic inside
    run.change_outer_loop();      // with another loop as g_0, if the texels then are more even: w = r / (z - c)
    run.normalize_core();         // z -> (z - a) / (1 - conj(a) z), with even texels or a vertex at 0 (section 4.3)
    run.attach_ears();            // each inside its hole, or along the unit circle
    run.remove_flips();           // det Dz > 0 in each face, as UVs of 32 bits store it
    run.mend_where_it_failed();   // the rest of the faces that are flipped, if they are few
    run.embed_where_it_failed();  // Tutte's theorem: one to one, not conformal
    run.polish();                 // least sum of |angle errors|, the circles kept
    run.make_even();              // from conformal to true to size
    return run.report(vertices, triangles);
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
    return run_on_copies<UniformizeResult>(context, uniformize_here, vertices, triangles, options);
}

UniformizeResult uniformize(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    ExecutionContext context;
    return uniformize(vertices, triangles, options, context);
}

}  // namespace koebe
