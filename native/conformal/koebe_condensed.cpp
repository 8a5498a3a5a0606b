#include "conformal/koebe_condensed.h"

#include "conformal/boundary_angles.h"
#include "conformal/circle_fit.h"
#include "conformal/disk_dirichlet_to_neumann.h"
#include "geometry/dense_spd.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace koebe {
namespace {

/// The constant to take off boundary values so that no net flux runs. Constants are in the kernel of Sigma + sum T_k,
/// so alpha 1 1' is added to make it invertible; a function without net flux has mean 0 and does not feel it,
/// whatever alpha.
/// @param fluxes (m, 2) of the boundary values and of the constant 1
double balancing_constant(const MatrixXd& fluxes) { return fluxes.col(0).sum() / fluxes.col(1).sum(); }

/// The pairs of one sweep, each loop in at least one; always the same, because partners that change from sweep to
/// sweep settle on a cycle of maps that differ by the discretization, not on one map.
std::vector<std::pair<int, int>> sweep_pairs(int loop_count, Method method)
{
    std::vector<std::pair<int, int>> pairs;
    if (method == Method::ck) {
        for (int k = 1; k < loop_count; ++k) pairs.emplace_back(0, k);
    } else {
        for (int k = 0; k + 1 < loop_count; k += 2) pairs.emplace_back(k, k + 1);
        if (loop_count % 2 == 1) pairs.emplace_back(0, loop_count - 1);
    }
    return pairs;
}

class CondensedKoebe {
public:
    CondensedKoebe(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<VectorXd>& edges)
        : edges_(edges), sigma_(surface.sigma())
    {
        Index begin = 0;
        for (std::size_t k = 0; k < loops.size(); ++k) {
            begin_.push_back(begin);
            size_.push_back(static_cast<Index>(loops[k].size()));
            begin += size_.back();
            weights_.push_back(vertex_weights(edges[k]));
            angles_.push_back(centered_angles(arc_length_angles(edges[k]), weights_[k]));
        }
    }

    int loop_count() const { return static_cast<int>(size_.size()); }

    /// A = Sigma + sum T_k for the present angles.
    void fill_all_loops()
    {
        filled_ = sigma_;
        for (int k = 0; k < loop_count(); ++k)
            filled_.block(begin_[k], begin_[k], size_[k], size_[k]) += disk_dirichlet_to_neumann(angles_[k]);
    }

    /// The map of S with all loops but the outer one filled and the outer one on the circle at its angles: harmonic,
    /// A_RR z_R = -A_R0 exp(i theta_0) on the rest R.
    std::vector<VectorXcd> images() const
    {
        const VectorXcd rim = unit_circle_points(angles_[0]);
        MatrixXd parts(size_[0], 2);
        parts << rim.real(), rim.imag();
        const Index rest = static_cast<Index>(filled_.rows()) - size_[0];
        const MatrixXd z =
            spd_solve(filled_.bottomRightCorner(rest, rest), -(filled_.bottomLeftCorner(rest, size_[0]) * parts));
        std::vector<VectorXcd> result{rim};
        for (int k = 1; k < loop_count(); ++k) {
            const auto rows = z.middleRows(begin_[k] - size_[0], size_[k]);
            result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
        }
        return result;
    }

    /// M = (A + alpha 1 1')^-1, what the pairs of a sweep are read from; two loops have no rest to eliminate.
    void invert()
    {
        if (loop_count() == 2) return;
        inverse_ = filled_;
        inverse_.array() += filled_.diagonal().mean() / static_cast<double>(filled_.rows());
        inverse_ = spd_inverse(std::move(inverse_));
    }

    /// One step: the conjugate of the harmonic function between loops i and j, on both of them.
    std::pair<VectorXd, VectorXd> open_pair(int i, int j, int& raised) const
    {
        const VectorXd flux = pair_flux(i, j);
        return {angles_from_flux(flux.head(size_[i]), edges_[i], raised),
                angles_from_flux(flux.tail(size_[j]), edges_[j], raised)};
    }

    void update(int k, const VectorXd& angles) { angles_[k] = centered_angles(angles, weights_[k], angles_[k]); }

private:
    VectorXd pair_flux(int i, int j) const
    {
        MatrixXd values = MatrixXd::Ones(size_[i] + size_[j], 2);
        values.col(0).head(size_[i]).setZero();
        if (loop_count() == 2) return sigma_ * values.col(0);
        MatrixXd pair(values.rows(), values.rows());
        pair << block(i, i), block(i, j), block(j, i), block(j, j);
        const MatrixXd fluxes = spd_solve(std::move(pair), values);
        return fluxes.col(0) - balancing_constant(fluxes) * fluxes.col(1);
    }

    Eigen::Block<const MatrixXd> block(int i, int j) const
    {
        return inverse_.block(begin_[i], begin_[j], size_[i], size_[j]);
    }

    const std::vector<VectorXd>& edges_;
    std::vector<VectorXd> weights_;
    MatrixXd sigma_;
    MatrixXd filled_;
    MatrixXd inverse_;
    std::vector<Index> begin_, size_;
    std::vector<VectorXd> angles_;
};

struct CircleState {
    std::vector<Circle> circles;
    double mean_roundness = 0.0;
};

CircleState fit_circles(const std::vector<VectorXcd>& images)
{
    CircleState state;
    for (const VectorXcd& image : images) {
        state.circles.push_back(fit_circle_least_squares(image));
        state.mean_roundness += roundness(image, state.circles.back()) / static_cast<double>(images.size());
    }
    return state;
}

/// (sum |c' - c|^2 + |r' - r|^2)^(1/2), the paper's termination test (section 4.4).
double circle_change(const std::vector<Circle>& before, const std::vector<Circle>& after)
{
    double squares = 0.0;
    for (std::size_t k = 0; k < before.size(); ++k) {
        const double radius_change = after[k].radius - before[k].radius;
        squares += std::norm(after[k].center - before[k].center) + radius_change * radius_change;
    }
    return std::sqrt(squares);
}

}  // namespace

KoebeOutcome koebe_condensed(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                             const std::vector<VectorXd>& edges, const VectorXd& areas,
                             const UniformizeOptions& options, ExecutionContext& context)
{
    KoebeOutcome outcome;
    if (loops.size() == 1) {
        const VectorXd torsion = surface.solve_interior(areas).values;
        Index deepest = 0;
        torsion.maxCoeff(&deepest);
        VectorXd source = VectorXd::Zero(areas.size());
        source[deepest] = 1.0;
        const VectorXd flux = surface.solve_interior(source).boundary_flux;
        const VectorXd angles = centered_angles(angles_from_flux(flux, edges[0], outcome.raised_angles),
                                                vertex_weights(edges[0]));
        outcome.loops = {unit_circle_points(angles)};
        outcome.converged = true;
        return outcome;
    }

    CondensedKoebe state(surface, loops, edges);
    const auto pairs = sweep_pairs(state.loop_count(), options.method);
    state.fill_all_loops();
    CircleState before = fit_circles(state.images());
    while (!outcome.converged && outcome.sweeps < options.max_sweeps) {
        context.advance(1.0 - std::pow(0.5, outcome.sweeps));
        outcome.raised_angles = 0;
        state.invert();
        context.checkpoint();
        std::vector<std::pair<VectorXd, VectorXd>> angles;
        for (const auto& [i, j] : pairs) {
            context.checkpoint();
            angles.push_back(state.open_pair(i, j, outcome.raised_angles));
        }
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            state.update(pairs[p].first, angles[p].first);
            state.update(pairs[p].second, angles[p].second);
        }
        state.fill_all_loops();
        context.checkpoint();
        outcome.loops = state.images();
        ++outcome.sweeps;
        CircleState after = fit_circles(outcome.loops);
        const double change = circle_change(before.circles, after.circles);
        // The steps of a sweep take effect together, with its last one.
        for (const auto& pair : pairs)
            outcome.history.push_back({++outcome.steps, pair, change, before.mean_roundness});
        outcome.history.back().mean_roundness = after.mean_roundness;
        // With two loops the step reads nothing of the state it replaces: it is exact.
        outcome.converged = change < options.tolerance || state.loop_count() == 2;
        before = std::move(after);
    }
    return outcome;
}

}  // namespace koebe
