#include "conformal/koebe_condensed.h"

#include "conformal/boundary_angles.h"
#include "conformal/circle_fit.h"
#include "conformal/disk_dirichlet_to_neumann.h"
#include "geometry/dense_spd.h"

#include <algorithm>
#include <cmath>

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

/// Flux 1 from the vertex deepest inside S: the one where the torsion function, K u = area, is largest.
InteriorSolution deepest_source(const CondensedLaplacian& surface, const VectorXd& areas)
{
    Index deepest = 0;
    surface.solve_interior(areas).values.maxCoeff(&deepest);
    VectorXd source = VectorXd::Zero(areas.size());
    source[deepest] = 1.0;
    return surface.solve_interior(source);
}

/// Sigma, the angles of every loop, and A = Sigma + sum T_k for the present angles.
class CondensedKoebe {
public:
    /// The first angles are those of the flux through each loop with all others open and at one voltage, Sigma_kk 1.
    /// @param source (m) flux that arrives at each boundary vertex from the source, for steps with one open loop
    CondensedKoebe(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<VectorXd>& edges, VectorXd source)
        : edges_(edges), source_(std::move(source)), sigma_(surface.sigma()), filled_(sigma_)
    {
        Index begin = 0;
        int raised = 0;
        for (int k = 0; k < static_cast<int>(loops.size()); ++k) {
            begin_.push_back(begin);
            size_.push_back(static_cast<Index>(loops[k].size()));
            begin += size_.back();
            weights_.push_back(vertex_weights(edges[k]));
            angles_.emplace_back();
            take_angles({k}, loops.size() > 1 ? VectorXd(sigma_block(k, k).rowwise().sum()) : source_, raised);
        }
    }

    int loop_count() const { return static_cast<int>(size_.size()); }

    /// The state with one loop alone: it is the outer one.
    VectorXcd rim() const { return unit_circle_points(angles_[0]); }

    /// The map of S with all loops but the outer one filled and the outer one on the circle at its angles: harmonic,
    /// A_RR z_R = -A_R0 exp(i theta_0) on the rest R.
    std::vector<VectorXcd> images() const
    {
        MatrixXd parts(size_[0], 2);
        parts << rim().real(), rim().imag();
        const Index rest = static_cast<Index>(filled_.rows()) - size_[0];
        const MatrixXd z =
            spd_solve(filled_.bottomRightCorner(rest, rest), -(filled_.bottomLeftCorner(rest, size_[0]) * parts));
        std::vector<VectorXcd> result{rim()};
        for (int k = 1; k < loop_count(); ++k) {
            const auto rows = z.middleRows(begin_[k] - size_[0], size_[k]);
            result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
        }
        return result;
    }

    /// M = (A + alpha 1 1')^-1, for flux_by_inverse().
    void invert()
    {
        inverse_ = filled_;
        inverse_.array() += filled_.diagonal().mean() / static_cast<double>(filled_.rows());
        inverse_ = spd_inverse(std::move(inverse_));
    }

    /// The flux through open loops, one after the other, all others filled and eliminated: of the harmonic function
    /// that is 0 on the first and 1 on the second, or of the source with one open loop at 0.
    VectorXd flux(const std::vector<int>& open) const
    {
        std::vector<int> rest;
        for (int k = 0; k < loop_count(); ++k)
            if (std::find(open.begin(), open.end(), k) == open.end()) rest.push_back(k);
        const auto load = [&](const std::vector<int>& rows) -> VectorXd {
            if (open.size() == 1) return -gather(source_, rows);
            return gather(sigma_, rows, {open[1]}).rowwise().sum();
        };
        if (rest.empty()) return load(open);
        return load(open) - gather(filled_, open, rest) * spd_solve(gather(filled_, rest, rest), load(rest));
    }

    /// The same, read off the inverse: M_PP q is that function on P up to a constant, which is such that no net flux
    /// runs. Constants are in the kernel of A; a function without net flux has mean 0 and does not feel alpha.
    VectorXd flux_by_inverse(const std::vector<int>& open) const
    {
        const Index count = static_cast<Index>(gather(source_, open).size());
        MatrixXd values = MatrixXd::Ones(count, 2);
        double net = 0.0;
        if (open.size() == 1) {
            values.col(0) = inverse_.middleRows(begin_[open[0]], count) * source_;
            net = source_.sum();
        } else {
            values.col(0).head(size_[open[0]]).setZero();
        }
        const MatrixXd fluxes = spd_solve(gather(inverse_, open, open), values);
        return fluxes.col(0) - (fluxes.col(0).sum() - net) / fluxes.col(1).sum() * fluxes.col(1);
    }

    /// New angles for open loops from the flux through them: the conjugate of the harmonic function.
    void take_angles(const std::vector<int>& open, const VectorXd& flux, int& raised)
    {
        Index row = 0;
        for (const int k : open) {
            angles_[k] = centered_angles(angles_from_flux(flux.segment(row, size_[k]), edges_[k], raised),
                                         weights_[k], angles_[k]);
            filled_.block(begin_[k], begin_[k], size_[k], size_[k]) =
                sigma_block(k, k) + disk_dirichlet_to_neumann(angles_[k]);
            row += size_[k];
        }
    }

private:
    Index total(const std::vector<int>& loops) const
    {
        Index n = 0;
        for (const int k : loops) n += size_[k];
        return n;
    }

    /// The rows and columns that belong to some loops.
    MatrixXd gather(const MatrixXd& matrix, const std::vector<int>& rows, const std::vector<int>& columns) const
    {
        MatrixXd result(total(rows), total(columns));
        Index left = 0;
        for (const int c : columns) {
            Index top = 0;
            for (const int r : rows) {
                result.block(top, left, size_[r], size_[c]) = matrix.block(begin_[r], begin_[c], size_[r], size_[c]);
                top += size_[r];
            }
            left += size_[c];
        }
        return result;
    }
    VectorXd gather(const VectorXd& vector, const std::vector<int>& rows) const
    {
        VectorXd result(total(rows));
        Index top = 0;
        for (const int r : rows) {
            result.segment(top, size_[r]) = vector.segment(begin_[r], size_[r]);
            top += size_[r];
        }
        return result;
    }

    Eigen::Block<const MatrixXd> sigma_block(int i, int j) const
    {
        return sigma_.block(begin_[i], begin_[j], size_[i], size_[j]);
    }

    const std::vector<VectorXd>& edges_;
    VectorXd source_;
    MatrixXd sigma_, filled_, inverse_;
    std::vector<Index> begin_, size_;
    std::vector<VectorXd> weights_, angles_;
};

}  // namespace

KoebeOutcome koebe_condensed(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                             const std::vector<VectorXd>& edges, const VectorXd& areas,
                             const UniformizeOptions& options, ExecutionContext& context)
{
    KoebeOutcome outcome;
    const bool sourced = loops.size() == 1 || (options.method == Method::ck && loops.size() > 2);
    CondensedKoebe state(surface, loops, edges,
                         sourced ? deepest_source(surface, areas).boundary_flux : VectorXd(VectorXd::Zero(surface.boundary_size())));
    if (loops.size() == 1) {
        outcome.loops = {state.rim()};
        outcome.converged = true;
        return outcome;
    }

    const auto steps = sweep_steps(state.loop_count(), options.method);
    const bool one_by_one = state.loop_count() <= most_loops_one_by_one;
    CircleState now = circle_state(state.images(), fit_circle_least_squares);
    // Steps that take effect together share the change and the roundness they lead to.
    const auto record = [&](std::size_t first, std::size_t last) {
        outcome.loops = state.images();
        CircleState next = circle_state(outcome.loops, fit_circle_least_squares);
        for (std::size_t s = first; s < last; ++s)
            outcome.history.push_back({++outcome.steps, {steps[s].front(), steps[s].back()}, circle_change(now, next),
                                       s + 1 == last ? next.mean_roundness : now.mean_roundness});
        now = std::move(next);
        context.advance(1.0 - std::pow(0.5, outcome.sweeps + static_cast<double>(last) / steps.size()));
    };
    while (!outcome.converged && outcome.sweeps < options.max_sweeps) {
        const CircleState at_sweep_start = now;
        outcome.raised_angles = 0;
        if (one_by_one) {
            for (std::size_t s = 0; s < steps.size(); ++s) {
                state.take_angles(steps[s], state.flux(steps[s]), outcome.raised_angles);
                record(s, s + 1);
            }
        } else {
            state.invert();
            context.checkpoint();
            std::vector<VectorXd> fluxes;
            for (const auto& open : steps) fluxes.push_back(state.flux_by_inverse(open));
            context.checkpoint();
            for (std::size_t s = 0; s < steps.size(); ++s)
                state.take_angles(steps[s], fluxes[s], outcome.raised_angles);
            record(0, steps.size());
        }
        ++outcome.sweeps;
        // With two loops the step reads nothing of the state it replaces: it is exact.
        outcome.converged = circle_change(at_sweep_start, now) < options.tolerance || state.loop_count() == 2;
    }
    return outcome;
}

}  // namespace koebe
