#include "pipeline/loop_images.h"

#include "circles/boundary_angles.h"
#include "circles/circle_fit.h"
#include "circles/crowded_circles.h"
#include "core/errors.h"
#include "iteration/koebe_mesh.h"
#include "pipeline/refinement.h"
#include "surface/curvature_weights.h"

#include <utility>

namespace koebe {
namespace {

constexpr Index most_refined_faces = 20000, most_for_the_mesh_engine = 4000;
constexpr Index most_faces_times_loops = 32000;  // of the mesh engine, which takes a step for each loop in a sweep
constexpr int most_refinements = 3;

std::vector<Index> boundary_of(const MapInput& input)
{
    std::vector<Index> boundary;
    for (const VertexLoop& loop : input.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    return boundary;
}

/// The outcome for a disk without inner vertices, where no harmonic function exists: its loop, spaced by length.
KoebeOutcome polygon_outcome(const MapInput& input)
{
    KoebeOutcome outcome;
    outcome.loops = {unit_circle_points(arc_length_angles(input.edges[0]))};
    outcome.converged = true;
    return outcome;
}

KoebeOutcome run_engine(const MapInput& input, const AssembledInput& assembled, const UniformizeOptions& options,
                        ExecutionContext& context, const KoebeOutcome* last = nullptr)
{
    if (options.engine == Engine::mesh)
        return koebe_mesh(input.vertices, input.surface, input.loops, options, context, options.mesh).outcome;
    if (!assembled.factored) return {};
    return koebe_condensed(assembled.laplacian, assembled.boundary, input.loops, input.edges, assembled.areas, options,
                           context, last);
}

bool finite(const KoebeOutcome& outcome)
{
    for (const VectorXcd& loop : outcome.loops)
        if (!loop.allFinite()) return false;
    return !outcome.loops.empty();
}

bool sound(const KoebeOutcome& outcome)
{
    if (outcome.raised_angles > 0 || !finite(outcome)) return false;
    std::vector<Circle> circles{Circle{}};
    for (std::size_t k = 1; k < outcome.loops.size(); ++k)
        circles.push_back(fit_circle_least_squares(outcome.loops[k]));
    return circles_apart(circles);
}

bool more_boundary_than_inside(const MapInput& input)
{
    std::size_t boundary = 0;
    for (const VertexLoop& loop : input.loops) boundary += loop.size();
    return static_cast<std::size_t>(input.surface.vertex_count) < 2 * boundary;
}

}  // namespace

void AssembledInput::take_metric(const MapInput& input)
{
    if (std::exchange(moved, false)) return;
    factored = false;
    boundary = {};
    places.reset();
    uses = 1;
    metric = intrinsic_metric(input.vertices, input.surface);
    take_laplacian(curvature_weights(metric, input.surface.vertex_count), input);
    areas = vertex_areas(metric.triangles, metric.lengths, input.surface.vertex_count);
    if (!moves) metric = {};
}

void AssembledInput::take_laplacian(const EdgeLengths& halves, const MapInput& input)
{
    SparseMatrix next = cotan_laplacian(metric.triangles, halves, input.surface.vertex_count);
    laplacian.swap(next);  // an assignment would copy
}

bool AssembledInput::move_metric(const MapInput& input)
{
    EdgeLengths halves;
    std::optional<IntrinsicMetric> kept = metric_with_flips_of(metric, input.vertices, input.surface, &halves);
    if (!kept) return false;
    metric = *std::move(kept);
    factored = false;
    moved = true;
    areas = vertex_areas(metric.triangles, metric.lengths, input.surface.vertex_count);
    correct_for_curvature(metric, input.surface.vertex_count, halves);
    if (uses > 1) {
        if (!places) places.emplace(metric.triangles, laplacian);
        places->fill(halves, laplacian);
    } else {
        take_laplacian(halves, input);
    }
    ++uses;
    return true;
}

void AssembledInput::factorize(const MapInput& input, const IterationOptions& options)
{
    try {
        if (boundary)
            boundary.solver().renew(laplacian);
        else
            boundary = condense(laplacian, input.loops, options);
        factored = true;
    } catch (...) {
        boundary = {};
        throw;
    }
}

void AssembledInput::reorder(const MapInput& input)
{
    if (!boundary || boundary.solver().reorder_boundary(boundary_of(input))) return;
    boundary = {};
    factored = false;
}

KoebeOutcome loop_images(const MapInput& input, const AssembledInput& assembled, const UniformizeOptions& options,
                         ExecutionContext& context, const KoebeOutcome* last)
{
    if (is_polygon(input)) return polygon_outcome(input);
    const auto attempt = [&](const auto& run) {
        try {
            return run();
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {
        } catch (const InputError&) {
        }
        return KoebeOutcome{};
    };
    KoebeOutcome outcome = attempt([&] { return run_engine(input, assembled, options, context, last); });
    const bool condensed = options.engine == Engine::condensed;
    bool wanting = !sound(outcome) || (condensed && more_boundary_than_inside(input));
    MapInput fine;
    Index stride = 1;
    for (int level = 0; level < most_refinements && wanting; ++level) {
        const MapInput& coarse = level == 0 ? input : fine;
        const Index most = condensed ? most_refined_faces
                                     : std::min(most_for_the_mesh_engine,
                                                most_faces_times_loops / static_cast<Index>(input.loops.size()));
        if (4 * coarse.surface.triangles.rows() > most) break;
        fine = refined_input(coarse);
        stride *= 2;
        KoebeOutcome finer = attempt([&] {
            AssembledInput refined;
            if (condensed) {
                refined.take_metric(fine);
                refined.factorize(fine, options);
            }
            return run_engine(fine, refined, options, context);
        });
        wanting = !sound(finer);
        if (!finite(finer) || (wanting && sound(outcome))) continue;
        for (VectorXcd& image : finer.step_images) image.conservativeResize(input.surface.vertex_count);
        for (VectorXcd& loop : finer.loops) loop = VectorXcd(loop(Eigen::seqN(0, loop.size() / stride, stride)));
        finer.angles.clear();  // they are for more vertices than the loops have
        outcome = std::move(finer);
    }
    return finite(outcome) ? outcome : KoebeOutcome{};
}

}  // namespace koebe
