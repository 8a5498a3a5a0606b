#include "conformal/koebe_condensed.h"

#include "conformal/boundary_angles.h"
#include "conformal/circle_fit.h"
#include "conformal/condensed_state.h"
#include "conformal/sparse_state.h"

#include <cmath>
#include <memory>
#include <utility>

namespace koebe {
namespace {

/// More loops are opened all at once: one inverse then costs less than an elimination for each step.
constexpr int most_loops_one_by_one = 8;

/// What every step of a sweep opens: two loops, or with the conventional form one.
std::vector<std::vector<int>> sweep_steps(int loop_count, Method method)
{
    std::vector<std::vector<int>> steps;
    if (method == Method::ck && loop_count > 2)
        for (int k = 0; k < loop_count; ++k) steps.push_back({k});
    else
        for (const auto& [i, j] : sweep_pairs(loop_count, Method::gk)) steps.push_back({i, j});
    return steps;
}

/// Feeds 1 into the vertex deepest inside S: the one where the torsion function, K u = area, is largest.
VectorXd deepest_source(const CondensedLaplacian& surface, const VectorXd& areas)
{
    Index deepest = 0;
    surface.solve_interior(areas).values.maxCoeff(&deepest);
    VectorXd source = VectorXd::Zero(areas.size());
    source[deepest] = 1.0;
    return source;
}

}  // namespace

KoebeOutcome koebe_condensed(const SparseMatrix& laplacian, const CondensedLaplacian& surface,
                             const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                             const VectorXd& areas, const UniformizeOptions& options, ExecutionContext& context)
{
    KoebeOutcome outcome;
    const bool sourced = loops.size() == 1 || (options.method == Method::ck && loops.size() > 2);
    const VectorXd source = sourced ? deepest_source(surface, areas) : VectorXd::Zero(areas.size());
    const auto flux_of_source = [&]() -> VectorXd {
        return sourced ? surface.solve_interior(source).boundary_flux : VectorXd::Zero(surface.boundary_size());
    };
    if (loops.size() == 1) {
        const VectorXd flux = flux_of_source();
        const VectorXd angles = angles_from_flux(flux, edges[0], outcome.raised_angles);
        outcome.loops.push_back(unit_circle_points(centered_angles(angles, vertex_weights(edges[0]))));
        outcome.converged = true;
        return outcome;
    }
    std::unique_ptr<FilledState> filled;
    if (surface.has_sigma())
        filled = std::make_unique<CondensedState>(surface, loops, edges, flux_of_source());
    else
        filled = std::make_unique<SparseState>(laplacian, surface, loops, edges, source);
    FilledState& state = *filled;

    const auto steps = sweep_steps(state.loop_count(), options.method);
    const std::size_t at_once =
        surface.has_sigma() && state.loop_count() <= most_loops_one_by_one ? 1 : steps.size();
    CircleState now = circle_state(state.images(), fit_circle_least_squares);
    // Steps that take effect together share the change and the roundness they lead to.
    const auto record = [&](std::size_t first, std::size_t last) {
        outcome.loops = state.images();
        CircleState next = circle_state(outcome.loops, fit_circle_least_squares);
        for (std::size_t s = first; s < last; ++s)
            outcome.history.push_back({++outcome.steps, std::pair(steps[s].front(), steps[s].back()),
                                       circle_change(now, next),
                                       s + 1 == last ? next.mean_roundness : now.mean_roundness, next.circles});
        now = std::move(next);
        context.advance(1.0 - std::pow(0.5, outcome.sweeps + static_cast<double>(last) / steps.size()));
    };
    while (!outcome.converged && outcome.sweeps < options.max_sweeps) {
        const CircleState at_sweep_start = now;
        outcome.raised_angles = 0;
        for (std::size_t first = 0; first < steps.size(); first += at_once) {
            const std::vector<std::vector<int>> opened(steps.begin() + first, steps.begin() + first + at_once);
            const std::vector<VectorXd> fluxes = state.fluxes(opened);
            context.checkpoint();
            for (std::size_t s = 0; s < at_once; ++s) state.take_angles(opened[s], fluxes[s], outcome.raised_angles);
            record(first, first + at_once);
        }
        ++outcome.sweeps;
        // With two loops the step reads nothing of the state it replaces: it is exact.
        outcome.converged = circle_change(at_sweep_start, now) < options.tolerance || state.loop_count() == 2;
    }
    return outcome;
}

}  // namespace koebe
