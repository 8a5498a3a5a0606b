#include "conformal/koebe_condensed.h"

#include "conformal/boundary_angles.h"
#include "conformal/circle_fit.h"
#include "conformal/condensed_state.h"
#include "conformal/grounded_state.h"
#include "conformal/sparse_state.h"
#include "core/memory_limit.h"

#include <cmath>
#include <memory>
#include <utility>

namespace koebe {
namespace {

constexpr double dense_copies = 5.0;  // Sigma, A, its factor, the inverse, and one on the way

/// With more loops one factor for all of them costs less than an elimination for each step; one or two leave no choice.
bool opened_at_once(const std::vector<VertexLoop>& loops) { return loops.size() <= 2 || loops.size() > 8; }

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

Index best_grounded(const std::vector<VertexLoop>& loops)
{
    std::size_t boundary = 0;
    for (const VertexLoop& loop : loops) boundary += loop.size();
    return opened_at_once(loops) && 3 * loops[0].size() >= boundary ? static_cast<Index>(loops[0].size()) : 0;
}

KoebeOutcome koebe_condensed(const SparseMatrix& laplacian, const CondensedLaplacian& surface,
                             const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                             const VectorXd& areas, const UniformizeOptions& options, ExecutionContext& context)
{
    KoebeOutcome outcome;
    const int loop_count = static_cast<int>(loops.size());
    const bool at_once = opened_at_once(loops) || !surface.has_sigma();
    const bool sourced = loop_count == 1 || (!at_once && options.method == Method::ck);
    const VectorXd flux_of_source = sourced ? surface.solve_interior(deepest_source(surface, areas)).boundary_flux
                                            : VectorXd::Zero(surface.boundary_size());
    if (loop_count == 1) {
        const VectorXd angles = angles_from_flux(flux_of_source, edges[0], outcome.raised_angles);
        outcome.loops.push_back(unit_circle_points(centered_angles(angles, vertex_weights(edges[0]))));
        outcome.converged = true;
        return outcome;
    }
    if (surface.has_sigma())
        require_memory(dense_copies * 8.0 * std::pow(surface.boundary_size(), 2), "the boundary's dense matrices");
    std::unique_ptr<GroundedState> grounded;
    std::unique_ptr<CondensedState> condensed;
    if (!surface.has_sigma())
        grounded = std::make_unique<SparseState>(laplacian, surface, loops, edges);
    else if (at_once)
        grounded = std::make_unique<DenseGroundedState>(surface, loops, edges);
    else
        condensed = std::make_unique<CondensedState>(surface, loops, edges, flux_of_source);
    FilledState& state = grounded ? static_cast<FilledState&>(*grounded) : *condensed;

    const auto steps = sweep_steps(loop_count, options.method);
    CircleState now;
    if (loop_count > 2) {
        if (at_once) state.take_angles({0}, grounded->outer_flux(), outcome.raised_angles);
        now = circle_state(state.images(), fit_circle_least_squares);
    }
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
        if (at_once) {
            const std::vector<VectorXd> fluxes = grounded->fluxes_against_outer();
            context.checkpoint();
            for (int k = 1; k < loop_count; ++k) state.take_angles({k}, fluxes[k - 1], outcome.raised_angles);
            state.take_angles({0}, grounded->outer_flux(), outcome.raised_angles);
            record(0, steps.size());
        }
        for (std::size_t s = 0; !at_once && s < steps.size(); ++s) {
            const VectorXd flux = condensed->flux(steps[s]);
            context.checkpoint();
            state.take_angles(steps[s], flux, outcome.raised_angles);
            record(s, s + 1);
        }
        ++outcome.sweeps;
        // With two loops the step reads nothing of the state it replaces: it is exact.
        outcome.converged = circle_change(at_sweep_start, now) < options.tolerance || loop_count == 2;
    }
    return outcome;
}

}  // namespace koebe
