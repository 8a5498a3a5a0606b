#include "pipeline/uniformize.h"

#include "conformal/boundary_angles.h"
#include "conformal/distortion.h"
#include "conformal/koebe_condensed.h"
#include "conformal/koebe_mesh.h"
#include "core/detachable_run.h"
#include "core/peak_memory.h"
#include "core/topology.h"
#include "foldover/angle_polish.h"
#include "foldover/flip_removal.h"
#include "foldover/flip_report.h"
#include "geometry/dense_spd.h"
#include "geometry/intrinsic_metric.h"
#include "pipeline/domain.h"
#include "pipeline/placement.h"

#include <chrono>
#include <optional>
#include <string>

namespace koebe {
namespace {

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

/// A disk without inner vertices has no harmonic function to speak of: its loop, evenly by length.
KoebeOutcome polygon_outcome(const Domain& domain)
{
    KoebeOutcome outcome;
    outcome.loops = {unit_circle_points(arc_length_angles(domain.edges[0]))};
    outcome.converged = true;
    return outcome;
}

void add_warnings(const Domain& domain, const KoebeOutcome& outcome, UniformizeResult& result)
{
    auto& warnings = result.warnings;
    const auto plural = [](std::size_t n, const std::string& noun) {
        return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
    };
    if (!domain.surface.unused.empty())
        warnings.push_back("vertices of no face, put at the centre: " + std::to_string(domain.surface.unused.size()) +
                           "; the first is " + std::to_string(domain.surface.unused.front()));
    if (!domain.surface.reoriented.empty())
        warnings.push_back(plural(domain.surface.reoriented.size(), "face") +
                           " turned to the orientation of the others; the first is " +
                           std::to_string(domain.surface.reoriented.front()));
    if (outcome.raised_angles > 0)
        warnings.push_back(plural(static_cast<std::size_t>(outcome.raised_angles), "boundary vertex step") +
                           " without flux, kept apart by a least distance");
    if (!outcome.converged)
        warnings.push_back("not converged in " + plural(static_cast<std::size_t>(outcome.sweeps), "sweep"));
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

    context.begin_stage("topology", 0.0, 0.05);
    const Domain whole = prepare_domain(vertices, triangles, options);
    FlapCut cut = cut_flaps(whole.vertices, whole.surface, whole.loops);
    std::optional<Domain> core;
    if (!cut.flaps.empty()) core = core_domain(whole, cut);
    const Domain& domain = core ? *core : whole;
    result.outer_loop = domain.outer_rank;
    result.seconds.topology = stage.lap();

    context.begin_stage("metric", 0.05, 0.15);
    const IntrinsicMetric metric = intrinsic_metric(domain.vertices, domain.surface);
    const Index vertex_count = domain.surface.vertex_count;
    const SparseMatrix laplacian = cotan_laplacian(metric.triangles, half_cotangents(metric.lengths), vertex_count);
    result.seconds.metric = stage.lap();

    context.begin_stage("factor", 0.15, 0.5);
    std::vector<Index> boundary;
    for (const VertexLoop& loop : domain.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    const DenseThreads threads(options.threads, static_cast<Index>(boundary.size()), result.face_count);
    const CondensedLaplacian condensed(laplacian, boundary, Ordering::amd, best_grounded(domain.loops));
    result.seconds.factor = stage.lap();

    context.begin_stage("iterate", 0.5, 0.9);
    const KoebeOutcome outcome =
        domain.loops.size() == 1 && domain.original.size() == domain.loops[0].size() ? polygon_outcome(domain)
        : options.engine == Engine::mesh
            ? koebe_mesh(domain.vertices, domain.surface, domain.loops, options, context).outcome
            : koebe_condensed(laplacian, condensed, domain.loops, domain.edges,
                              vertex_areas(metric.triangles, metric.lengths, vertex_count), options, context);
    result.converged = outcome.converged;
    result.sweeps = outcome.sweeps;
    result.steps = outcome.steps;
    result.history = outcome.history;
    result.seconds.iterate = stage.lap();

    context.begin_stage("finish", 0.9, 1.0);
    int outer = 0;
    PlanarPoints core_uv = finish_map(condensed, laplacian, domain, cut, outcome, options, result, outer);
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
    const NamedSurface named{whole.vertices, whole.surface, whole.loops, whole.original};
    const std::vector<Circle> circles = reported_circles(result.loops);
    UntangledMap map = remove_flips(named, cut, std::move(core_uv), circles, context);
    if (options.polish) {
        context.begin_stage("polish", 0.97, 1.0);
        result.unpolished_angle_error_deg =
            measure_distortion(whole.vertices, whole.surface.triangles, map.uv).angle_error_deg;
        polish_angles(whole.vertices, whole.surface, whole.loops, circles, map.off_circle, map.uv, context);
    }
    report_map(named, map, result);
    add_warnings(whole, outcome, result);
    const auto flip_sentences = flip_warnings(named, map.uv, cut.flaps, map.report, result.distortion);
    result.warnings.insert(result.warnings.end(), flip_sentences.begin(), flip_sentences.end());
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
