#include "conformal/uniformize.h"

#include "conformal/area_balance.h"
#include "conformal/boundary_angles.h"
#include "conformal/circle_fit.h"
#include "conformal/circle_projection.h"
#include "conformal/distortion.h"
#include "conformal/flip_removal.h"
#include "conformal/flip_report.h"
#include "conformal/flux_balance.h"
#include "conformal/koebe_condensed.h"
#include "conformal/koebe_mesh.h"
#include "conformal/moebius.h"
#include "conformal/rim_room.h"
#include "core/detachable_run.h"
#include "core/topology.h"
#include "geometry/dense_spd.h"
#include "geometry/flaps.h"
#include "geometry/intrinsic_metric.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace koebe {
namespace {

constexpr std::size_t outer_candidates = 8;      // the longest loops, to choose the outer one from
constexpr Eigen::Index outer_sample = 2000;      // faces to judge the choice by
constexpr Eigen::Index balance_sample = 20000;   // faces to balance by

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

double peak_memory_mb()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// The surface on its used vertices alone, with the loops in the order of the iteration.
struct Domain {
    Surface surface;
    Vertices vertices;
    std::vector<Index> original;       // vertex of the input for each vertex
    std::vector<VertexLoop> loops;     // outer first, then by falling length on the surface
    std::vector<VectorXd> edges;       // length of the edge from each loop vertex to the next
    int outer_rank = 0;                // of the outer loop in the surface's own order
};

/// Length of the edge from each vertex of a loop to the next. Vertices that coincide in space still need an angle of
/// their own, so no edge counts for less than 1e-9 of the mean.
VectorXd loop_edges(const Vertices& vertices, const VertexLoop& loop)
{
    VectorXd edges(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i)
        edges[i] = (vertices.row(loop[(i + 1) % loop.size()]) - vertices.row(loop[i])).stableNorm();
    return edges.cwiseMax(1e-9 * edges.mean());
}

int choose_outer_loop(const Domain& domain, const UniformizeOptions& options)
{
    const auto& loops = domain.surface.loops;
    if (options.outer == OuterLoop::vertex) {
        const auto compact = std::find(domain.original.begin(), domain.original.end(), options.outer_vertex);
        const Index vertex = static_cast<Index>(compact - domain.original.begin());
        for (std::size_t k = 0; k < loops.size(); ++k)
            if (std::find(loops[k].begin(), loops[k].end(), vertex) != loops[k].end()) return static_cast<int>(k);
        throw InputError("vertex " + std::to_string(options.outer_vertex) + " lies on no boundary loop",
                         {options.outer_vertex});
    }
    int longest = 0;
    double length = 0.0;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (const double l = loop_edges(domain.vertices, loops[k]).sum(); l > length) {
            length = l;
            longest = static_cast<int>(k);
        }
    return longest;
}

Domain prepare_domain(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    validate_arrays(vertices, triangles);
    Domain domain;
    domain.surface = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));

    std::vector<Index> rank(vertices.rows(), 0);
    for (const Index v : domain.surface.unused) rank[v] = -1;
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v)
        if (rank[v] == 0) {
            rank[v] = static_cast<Index>(domain.original.size());
            domain.original.push_back(v);
        }
    // Centred and scaled, so that no length overflows and the result does not depend on the unit.
    domain.vertices = vertices(domain.original, Eigen::all);
    domain.vertices.rowwise() -= domain.vertices.colwise().mean().eval();
    const double scale = domain.vertices.cwiseAbs().maxCoeff();
    if (!(scale > 0.0)) throw InputError("all vertices lie on one point");
    domain.vertices /= scale;
    if (!domain.surface.unused.empty()) {
        for (Index* i = domain.surface.triangles.data(); i != domain.surface.triangles.data() + 3 * triangles.rows();
             ++i)
            *i = rank[*i];
        for (VertexLoop& loop : domain.surface.loops)
            for (Index& v : loop) v = rank[v];
        domain.surface.vertex_count = static_cast<Index>(domain.original.size());
    }

    domain.outer_rank = choose_outer_loop(domain, options);
    std::vector<int> order(domain.surface.loops.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> length;
    for (const VertexLoop& loop : domain.surface.loops) length.push_back(loop_edges(domain.vertices, loop).sum());
    length[domain.outer_rank] = std::numeric_limits<double>::infinity();
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[a] > length[b]; });
    for (const int k : order) {
        domain.loops.push_back(domain.surface.loops[k]);
        domain.edges.push_back(loop_edges(domain.vertices, domain.loops.back()));
    }
    return domain;
}

/// The domain without its flaps.
Domain core_domain(const Domain& whole, FlapCut& cut)
{
    Domain core;
    core.surface = std::move(cut.core);
    core.vertices = whole.vertices(cut.vertices, Eigen::all);
    for (const Index v : cut.vertices) core.original.push_back(whole.original[v]);
    core.loops = cut.loops;
    for (const VertexLoop& loop : core.loops) core.edges.push_back(loop_edges(core.vertices, loop));
    core.outer_rank = whole.outer_rank;
    return core;
}

/// A disk without inner vertices has no harmonic function to speak of: its loop, evenly by length.
KoebeOutcome polygon_outcome(const Domain& domain)
{
    KoebeOutcome outcome;
    outcome.loops = {unit_circle_points(arc_length_angles(domain.edges[0]))};
    outcome.converged = true;
    return outcome;
}

/// The automorphism that puts the map into normal position: two loops concentric, else nothing.
Moebius normal_position(const std::vector<Circle>& circles)
{
    return circles.size() == 2 ? center_circle(circles[1]) : Moebius{};
}

/// The images of the loops in normal position, each put on its circle: (m, 2), loop after loop. Fills the loop reports.
MatrixXd place_on_circles(const Domain& domain, const FlapCut& cut, const KoebeOutcome& outcome,
                          UniformizeResult& result)
{
    std::vector<Circle> circles{Circle{}};
    for (std::size_t k = 1; k < outcome.loops.size(); ++k)
        circles.push_back(fit_circle_least_squares(outcome.loops[k]));
    const Moebius moebius = normal_position(circles);

    std::size_t boundary_count = 0;
    for (const VectorXcd& loop : outcome.loops) boundary_count += loop.size();
    MatrixXd boundary(boundary_count, 2);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < outcome.loops.size(); ++k) {
        LoopReport report;
        report.circle = k == 0 ? Circle{} : moebius(circles[k]);
        const VectorXcd image = moebius(outcome.loops[k]);
        report.roundness = roundness(image, report.circle);
        const VectorXcd projected =
            k == 0 ? project_onto_circle(report.circle, image, 1,
                                         rim_room(domain.surface, domain.loops[0], cut.flaps, cut.vertices))
                   : project_onto_circle(report.circle, image, -1);
        report.roundness_projected = roundness(projected, report.circle);
        for (const Index v : domain.loops[k]) report.vertices.push_back(domain.original[v]);
        boundary.middleRows(row, projected.size()) << projected.real(), projected.imag();
        row += projected.size();
        result.loops.push_back(std::move(report));
    }
    return boundary;
}

std::vector<Circle> reported_circles(const UniformizeResult& result)
{
    std::vector<Circle> circles;
    for (const LoopReport& report : result.loops) circles.push_back(report.circle);
    return circles;
}

/// Circles fitted, boundary put on them, interior harmonic, the map balanced if asked for: the domain's vertices.
/// @param outer the rank of the loop that should be the outer one: 0 unless it is to be chosen and another one is
///        better; then the map is not balanced
PlanarPoints finish_map(const CondensedLaplacian& condensed, const SparseMatrix& laplacian, const Domain& domain,
                        const FlapCut& cut, const KoebeOutcome& outcome, const UniformizeOptions& options,
                        UniformizeResult& result, int& outer)
{
    MatrixXd boundary = place_on_circles(domain, cut, outcome, result);
    std::vector<Circle> circles = reported_circles(result);
    balance_flux(condensed, laplacian, domain.loops, circles, boundary);
    PlanarPoints uv = condensed.extend(boundary);
    if (options.balance == Balance::area) {
        if (options.outer == OuterLoop::automatic) {
            std::vector<int> longest(std::min(circles.size(), outer_candidates));
            std::iota(longest.begin(), longest.end(), 0);
            outer = balanced_outer_loop(face_scales(domain.vertices, domain.surface.triangles, uv, outer_sample),
                                        circles, longest);
        }
        result.unbalanced_area = measure_distortion(domain.vertices, domain.surface.triangles, uv).area;
        if (outer != 0) return uv;
        double distortion = 0.0;
        const Moebius balance = least_area_distortion(
            face_scales(domain.vertices, domain.surface.triangles, uv, balance_sample), distortion);
        const VectorXcd moved = balance(boundary.col(0) + Complex(0.0, 1.0) * boundary.col(1));
        boundary << moved.real(), moved.imag();
        for (std::size_t k = 1; k < circles.size(); ++k) circles[k] = balance(circles[k]);
        // An annulus would be made concentric again.
        if (circles.size() > 2) balance_flux(condensed, laplacian, domain.loops, circles, boundary);
        uv = condensed.extend(boundary);
    }
    for (std::size_t k = 0; k < circles.size(); ++k) result.loops[k].circle = circles[k];
    return uv;
}

void add_warnings(const Domain& domain, const KoebeOutcome& outcome, UniformizeResult& result)
{
    auto& warnings = result.warnings;
    const auto plural = [](std::size_t n, const std::string& noun) {
        return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
    };
    if (!domain.surface.unused.empty())
        warnings.push_back("vertices of no face, put at the centre: " +
                           std::to_string(domain.surface.unused.size()) + "; the first is " +
                           std::to_string(domain.surface.unused.front()));
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
    const SparseMatrix laplacian =
        cotan_laplacian(metric.triangles, half_cotangents(metric.lengths), vertex_count);
    result.seconds.metric = stage.lap();

    context.begin_stage("factor", 0.15, 0.5);
    std::vector<Index> boundary;
    for (const VertexLoop& loop : domain.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    const DenseThreads threads(options.threads, static_cast<Index>(boundary.size()), result.face_count);
    const CondensedLaplacian condensed(laplacian, boundary, Ordering::amd);
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
    UntangleReport untangled;
    const PlanarPoints uv = remove_flips({whole.vertices, whole.surface, whole.loops, whole.original}, cut,
                                         std::move(core_uv), result.loops, untangled, context);
    result.distortion = measure_distortion(whole.vertices, whole.surface.triangles, uv);
    result.uv = PlanarPoints::Zero(vertices.rows(), 2);
    result.uv(whole.original, Eigen::all) = uv;
    add_warnings(whole, outcome, result);
    const auto flip_sentences = flip_warnings({whole.vertices, whole.surface, whole.loops, whole.original}, uv,
                                              cut.flaps, untangled, result.distortion);
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
    return run_detachable<UniformizeResult>(
        context, [vertices, triangles, options](ExecutionContext& own) {
            return run_pipeline(vertices, triangles, options, own);
        });
}

}  // namespace koebe
