#include "iteration/koebe_condensed.h"

#include "circles/boundary_angles.h"
#include "execution/memory_limit.h"
#include "iteration/condensed_state.h"
#include "iteration/convergence.h"
#include "iteration/grounded_state.h"
#include "iteration/sparse_state.h"
#include "iteration/sweep_order.h"
#include "surface/deepest_vertex.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace koebe {
namespace {

constexpr double dense_copies = 5.0;  // Sigma, A, its factor, the inverse, and a temporary

constexpr std::size_t few_loops = 8;  // up to here CK and the first algorithm take one step after another

/// Whether each step starts from the angles of the last one (block Gauss-Seidel). Otherwise all steps of a sweep start
/// from the same angles (block Jacobi). Two loops have one step a sweep, and no order.
bool is_gauss_seidel(const std::vector<VertexLoop>& loops, const IterationOptions& options)
{
    if (loops.size() <= 2) return false;
    return options.gauss_seidel || (options.method != Method::gk && loops.size() <= few_loops);
}

constexpr double longest = 3000.0;  // a Sigma of 72 MB

/// The largest number of boundary vertices for which a Sigma is cheaper than the sparse matrix. A separator of the
/// surface has about sqrt(V) vertices; a Sigma of 5 times as many costs as much as the sparse factor's rows that the
/// disks reach.
double most_kept(double vertex_count) { return std::min(longest, 5.0 * std::sqrt(vertex_count)); }

/// A third of the boundary in Sigma costs more than a substitution in each sweep, unless Sigma is small.
bool grounds_outer_loop(const std::vector<VertexLoop>& loops, std::size_t boundary_size, double vertex_count)
{
    const bool cheap = loops.size() > 2 && static_cast<double>(boundary_size) < 3.5 * std::sqrt(vertex_count);
    return 3 * loops[0].size() >= boundary_size && !cheap;
}

/// The flux at the boundary from a source of 1 in the vertex deepest inside S.
VectorXd flux_of_deepest_source(BoundarySolver& surface, const VectorXd& areas)
{
    VectorXd source = VectorXd::Zero(areas.size());
    source[deepest_vertex(surface, areas)] = 1.0;
    return surface.solve_interior(source).boundary_flux;
}

/// The Riemann map (section 4.3): the rim's angles are the running sum of the flux from a source inside.
KoebeOutcome riemann_map(BoundarySolver& surface, const VectorXd& edges, const VectorXd& areas)
{
    KoebeOutcome outcome;
    const VectorXd angles = angles_from_flux(flux_of_deepest_source(surface, areas), edges, outcome.raised_angles);
    outcome.loops.push_back(unit_circle_points(centered_angles(angles, vertex_weights(edges))));
    outcome.converged = true;
    return outcome;
}

/// @param jacobi whether all steps of a sweep start from the same angles
/// @param areas for the source of CK's steps one after another
std::unique_ptr<FilledState> first_state(const SparseMatrix& laplacian, const FactoredSurface& surface,
                                         const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                                         const VectorXd& areas, Method method, bool jacobi,
                                         const std::vector<VectorXd>& first)
{
    if (surface.sparse) return std::make_unique<SparseState>(laplacian, *surface.sparse, loops, edges, first);
    CondensedLaplacian& dense = *surface.dense;
    const VectorXd source =
        !jacobi && method == Method::ck ? flux_of_deepest_source(dense, areas) : VectorXd::Zero(dense.boundary_size());
    require_memory(dense_copies * 8.0 * std::pow(dense.boundary_size(), 2), "the boundary's dense matrices");
    if (jacobi) return std::make_unique<DenseGroundedState>(dense, loops, edges, first);
    return std::make_unique<CondensedState>(dense, loops, edges, source, first);
}

/// The first angles from the last outcome; empty unless there is one angle per loop vertex.
std::vector<VectorXd> first_angles(const KoebeOutcome* last, const std::vector<VertexLoop>& loops)
{
    if (!last || last->angles.size() != loops.size()) return {};
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (last->angles[k].size() != static_cast<Eigen::Index>(loops[k].size())) return {};
    return last->angles;
}

/// The largest ratio of a sweep's change to the change before, as long as rounding does not hide it.
class Contraction {
public:
    explicit Contraction(double known) : known_(known) {}
    void add(double change)
    {
        if (last_ > rounding) measured_ = std::max(measured_, change / last_);
        last_ = change;
    }
    double value() const { return measured_ > 0.0 ? std::min(measured_, 1.0) : known_; }

private:
    static constexpr double rounding = 1e-10;
    double known_, measured_ = 0.0, last_ = 0.0;
};

}  // namespace

FactoredSurface condense(const SparseMatrix& laplacian, const std::vector<VertexLoop>& loops,
                         const IterationOptions& options, std::optional<std::size_t> most_condensed)
{
    std::vector<Index> boundary;
    for (const VertexLoop& loop : loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    const bool all = is_gauss_seidel(loops, options);
    const auto vertex_count = static_cast<double>(laplacian.rows());
    const Index grounded =
        !all && grounds_outer_loop(loops, boundary.size(), vertex_count) ? static_cast<Index>(loops[0].size()) : 0;
    const std::size_t most = most_condensed.value_or(static_cast<std::size_t>(all ? longest : most_kept(vertex_count)));
    if (loops.size() > 1 && boundary.size() - grounded > most)
        return {.dense = nullptr, .sparse = std::make_unique<FilledLaplacian>(laplacian, loops)};
    return {.dense = std::make_unique<CondensedLaplacian>(laplacian, boundary, grounded), .sparse = nullptr};
}

KoebeOutcome koebe_condensed(const SparseMatrix& laplacian, const FactoredSurface& surface,
                             const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                             const VectorXd& areas, const IterationOptions& options, ExecutionContext& context,
                             const KoebeOutcome* last)
{
    const int loop_count = static_cast<int>(loops.size());
    if (loop_count == 1) return riemann_map(surface.solver(), edges[0], areas);

    // The state: one angle for each boundary vertex, from the last outcome or from the flux through the open loops.
    KoebeOutcome outcome;
    const std::vector<VectorXd> first = first_angles(last, loops);
    const std::unique_ptr<FilledState> state =
        first_state(laplacian, surface, loops, edges, areas, options.method, !is_gauss_seidel(loops, options), first);
    CircleState now;
    if (loop_count > 2) {
        state->start(outcome.raised_angles);
        now = circle_state(state->images());
    }

    // The steps of a sweep: block Jacobi takes all of them together, block Gauss-Seidel one after another.
    const Sweep sweep = fixed_sweep(loop_count, options.method);
    std::vector<Sweep> order;
    if (state->opens_at_once())
        order.push_back(sweep);
    else
        for (const OpenedLoops& step : sweep) order.push_back({step});
    const auto record = [&](const Sweep& together) {  // these steps share the resulting change and roundness
        outcome.loops = state->images();
        CircleState next = circle_state(outcome.loops);
        for (const OpenedLoops& open : together)
            outcome.history.push_back({++outcome.steps, std::pair(open.front(), open.back()), circle_change(now, next),
                                       &open == &together.back() ? next.mean_roundness : now.mean_roundness,
                                       next.circles});
        now = std::move(next);
    };

    // Sweeps, until the circles stay. With two loops one step is exact. From the angles of a last outcome the
    // contraction q is known: the next sweep moves the circles by q times the change.
    Contraction contraction(first.empty() ? 1.0 : last->contraction);
    while (!outcome.converged && outcome.sweeps < options.max_sweeps) {
        // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): record() changes now
        const CircleState at_sweep_start = now;
        outcome.raised_angles = 0;
        for (std::size_t s = 0; s < order.size(); ++s) {
            context.checkpoint();
            state->take_steps(order[s], outcome.raised_angles);
            context.checkpoint();
            record(order[s]);
            context.advance(1.0 - std::pow(0.5, outcome.sweeps + static_cast<double>(s + 1) / order.size()));
        }
        ++outcome.sweeps;
        outcome.converged = has_converged(at_sweep_start, now, options.tolerance);
        if (loop_count == 2) break;
        const double change = circle_change(at_sweep_start, now);
        contraction.add(change);
        if (!first.empty() && 3.0 * contraction.value() * change < options.tolerance) outcome.converged = true;
    }
    outcome.contraction = contraction.value();
    outcome.angles = state->angles();
    return outcome;
}

}  // namespace koebe
