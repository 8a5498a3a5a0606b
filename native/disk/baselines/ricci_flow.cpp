#include "baselines/ricci_flow.h"

#include "circles/circle_fit.h"
#include "core/connectivity.h"
#include "flow/curvature.h"
#include "flow/flat_layout.h"
#include "iteration/convergence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

using std::numbers::pi;
constexpr double hole_damping = 2.0 / 3.0;  // then the factors of all modes lie within 1/3
constexpr double newton_per_target = 1e-3;  // a moving target need not be met better than that

/// The half-edges of a loop, in the order of its vertices.
std::vector<Index> loop_halfedges(const Triangles& triangles, const std::vector<Index>& twin, const VertexLoop& loop)
{
    std::vector<std::pair<Index, Index>> leaving;
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] == no_twin) leaving.emplace_back(origin(triangles, h), h);
    std::sort(leaving.begin(), leaving.end());
    std::vector<Index> halfedges;
    for (const Index v : loop)
        halfedges.push_back(std::lower_bound(leaving.begin(), leaving.end(), std::pair(v, Index{0}))->second);
    return halfedges;
}

/// Half the central angles of the circle in which a polygon with these edges is inscribed, sum pi.
VectorXd chord_angles(const VectorXd& edges)
{
    Eigen::Index longest = 0;
    const double length = edges.maxCoeff(&longest);
    if (!(2.0 * length < edges.sum())) return pi * edges / edges.sum();  // no polygon has such edges
    // s = 1 / diameter. With the centre beyond the longest edge, that edge's angle is the rest of the turn.
    const auto angles = [&](double s) -> VectorXd { return (s * edges).cwiseMin(1.0).array().asin(); };
    const bool behind = angles(1.0 / length).sum() < pi;
    const auto too_small = [&](double s) {
        const VectorXd at = angles(s);
        return behind ? at.sum() > 2.0 * at[longest] : at.sum() < pi;
    };
    double low = 0.0, high = 1.0 / length;
    while (high - low > 1e-15 * high) {
        const double middle = 0.5 * (low + high);
        (too_small(middle) ? low : high) = middle;
    }
    VectorXd result = angles(0.5 * (low + high));
    if (behind) result[longest] = pi - result[longest];
    return result * (pi / result.sum());
}

/// Lays the metric out along a tree where lengths differ too much for least squares in double precision.
VectorXcd laid_out(const Triangles& triangles, const EdgeLengths& lengths, const VectorXcd& edges, Index vertex_count)
{
    try {
        return positions_from_edges(triangles, lengths, edges, vertex_count);
    } catch (const SolverError&) {
        return positions_along_tree(triangles, edges, vertex_count);
    }
}

class RicciFlow {
public:
    RicciFlow(const IntrinsicMetric& metric, Index vertex_count, const std::vector<VertexLoop>& loops,
              const RicciFlowOptions& options)
        : triangles_(metric.triangles),
          loops_(loops),
          options_(options),
          twin_(metric.twin),
          packing_(circle_packing(triangles_, metric.lengths, vertex_count, options.packing)),
          u_(packing_.log_radii),
          energy_(triangles_, packing_, mask(vertex_count, loops))
    {
        for (const VertexLoop& loop : loops) halfedges_.push_back(loop_halfedges(triangles_, twin_, loop));
    }

    RicciFlowResult run(ExecutionContext& context)
    {
        RicciFlowResult result;
        result.packing_change = packing_.changed;
        KoebeOutcome& outcome = result.outcome;
        CircleState now;
        while (!outcome.converged && outcome.sweeps < options_.max_updates) {
            // The target: curvature 0 inside, and on each loop the curvature of a circle with its present lengths.
            const double moved = update_target();
            energy_.set_target(target_);
            // The metric of this curvature: the minimum of the convex Ricci energy. While the target moves, not farther
            // than it moved.
            NewtonOptions newton = options_.newton;
            newton.tolerance = std::max(newton.tolerance, newton_per_target * std::min(moved, 1e-3));
            const NewtonReport report = newton_.minimize(energy_, u_, newton, context);
            ++outcome.sweeps;
            outcome.steps += report.steps;
            result.curvature_error = report.residuals.back();
            lay_out(result);
            // The end: circles and target stay.
            CircleState next = circle_state(outcome.loops);
            const double change = circle_change(now, next);
            outcome.history.push_back({outcome.steps, {0, 0}, change, next.mean_roundness, next.circles});
            now = std::move(next);
            context.advance(1.0 - std::pow(0.8, outcome.sweeps));
            if (!report.converged) {
                result.reason = report.reason + ": curvature off by up to " + std::to_string(result.curvature_error);
                break;
            }
            outcome.converged = change < options_.tolerance && moved < options_.tolerance;
        }
        if (!outcome.converged && result.reason.empty())
            result.reason = "the boundary's target still moves after " + std::to_string(outcome.sweeps) + " updates";
        // Faces without a triangle inequality: no metric of this curvature exists on the triangulation.
        result.target = target_;
        result.collapsed = collapsed_faces(energy_.lengths());
        if (!result.collapsed.empty()) {
            outcome.converged = false;
            result.reason = std::to_string(result.collapsed.size()) +
                            (result.collapsed.size() == 1 ? " face has" : " faces have") +
                            " collapsed (no metric on this triangulation has the curvature wanted)" +
                            (result.reason.empty() ? "" : "; " + result.reason);
        }
        return result;
    }

private:
    static std::vector<char> mask(Index vertex_count, const std::vector<VertexLoop>& loops)
    {
        std::vector<char> boundary(vertex_count, 0);
        for (const VertexLoop& loop : loops)
            for (const Index v : loop) boundary[v] = 1;
        return boundary;
    }

    /// Moves the target towards the present lengths'. @return the largest change, radians
    double update_target()
    {
        energy_.set_target(VectorXd::Zero(u_.size()));
        energy_.gradient(u_);
        VectorXd wanted = VectorXd::Zero(u_.size());
        double moved = 0.0;
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            VectorXd edges(loops_[k].size());
            for (std::size_t b = 0; b < loops_[k].size(); ++b) edges[b] = energy_.lengths().data()[halfedges_[k][b]];
            const VectorXd turning = (k == 0 ? 1.0 : -1.0) * turning_angles(edges, options_.target);
            for (std::size_t b = 0; b < loops_[k].size(); ++b) {
                const Index v = loops_[k][b];
                const bool first = target_.size() == 0;
                const double damping = first || k == 0 ? 1.0 : hole_damping;
                const double old = first ? 0.0 : target_[v];
                wanted[v] = old + damping * (turning[b] - old);
                moved = std::max(moved, std::abs(wanted[v] - old));
            }
        }
        target_ = std::move(wanted);
        return moved;
    }

    void lay_out(RicciFlowResult& result) const
    {
        const EdgeLengths& lengths = energy_.lengths();
        const VectorXcd edges = unfolded_edges(triangles_, lengths, twin_);
        const VectorXcd plane = laid_out(triangles_, lengths, edges, static_cast<Index>(u_.size()));
        result.closing_gap = 0.0;
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            Complex gap = 0.0;
            double length = 0.0;
            for (const Index h : halfedges_[k]) {
                gap += edges[h];
                length += std::abs(edges[h]);
            }
            result.closing_gap = std::max(result.closing_gap, std::abs(gap) / length);
        }
        const Circle outer = fit_circle_least_squares(gather_loop(plane, loops_[0]));
        result.positions = (plane.array() - outer.center) / outer.radius;
        result.outcome.loops.clear();
        for (const VertexLoop& loop : loops_) result.outcome.loops.push_back(gather_loop(result.positions, loop));
    }

    const Triangles& triangles_;
    const std::vector<VertexLoop>& loops_;
    RicciFlowOptions options_;
    const std::vector<Index>& twin_;
    CirclePacking packing_;
    VectorXd u_;
    RicciEnergy energy_;
    ConvexNewton newton_;
    std::vector<std::vector<Index>> halfedges_;
    VectorXd target_;
};

}  // namespace

RicciEnergy::RicciEnergy(const Triangles& triangles, CirclePacking packing, std::vector<char> boundary)
    : triangles_(triangles),
      packing_(std::move(packing)),
      boundary_(std::move(boundary)),
      target_(VectorXd::Zero(packing_.log_radii.size()))
{
}

VectorXd RicciEnergy::gradient(const VectorXd& log_radii)
{
    log_radii_ = log_radii;
    lengths_ = packing_lengths(triangles_, packing_, log_radii);
    return discrete_curvature(triangles_, lengths_, boundary_) - target_;
}

SparseMatrix RicciEnergy::hessian() const
{
    return cotan_laplacian(triangles_, power_weights(triangles_, lengths_, log_radii_),
                           static_cast<Index>(log_radii_.size()));
}

VectorXd turning_angles(const VectorXd& edges, BoundaryTarget target)
{
    VectorXd central = 2.0 * pi * edges / edges.sum();
    if (target == BoundaryTarget::inscribed) central = 2.0 * chord_angles(edges);
    VectorXd turning(edges.size());
    for (Eigen::Index b = 0; b < edges.size(); ++b)
        turning[b] = 0.5 * (central[b] + central[(b + edges.size() - 1) % edges.size()]);
    return turning;
}

RicciFlowResult ricci_flow(const IntrinsicMetric& metric, Index vertex_count, const std::vector<VertexLoop>& loops,
                           const RicciFlowOptions& options, ExecutionContext& context)
{
    return RicciFlow(metric, vertex_count, loops, options).run(context);
}

}  // namespace koebe
