#include "flow/convex_newton.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

constexpr double largest_change = 4.0;  // change of any entry of u: a factor of 55 in a length
constexpr double widest_range = 60.0;   // of u: beyond it u diverges, as there is no minimum
constexpr double shortest_step = 1e-9;  // of the first step tried
constexpr double first_shift = 1e-12;   // of the mean diagonal
constexpr double last_shift = 1e-2;

std::vector<Index> pattern_of(const SparseMatrix& matrix)
{
    std::vector<Index> pattern(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1);
    pattern.insert(pattern.end(), matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
    return pattern;
}

/// The Hessian without the constants in its kernel, and with 1 on the diagonal of empty rows. The right-hand side sums
/// to 0, so the entry added at one vertex moves only the constant.
SparseMatrix grounded(const SparseMatrix& hessian, double shift)
{
    const VectorXd diagonal = hessian.diagonal();
    VectorXd added = VectorXd::Constant(diagonal.size(), shift);
    Eigen::Index pinned = 0;
    diagonal.maxCoeff(&pinned);
    added[pinned] += diagonal[pinned];
    for (Eigen::Index v = 0; v < diagonal.size(); ++v)
        if (diagonal[v] == 0.0) added[v] = 1.0;
    std::vector<Eigen::Triplet<double, Index>> triplets;
    for (Index v = 0; v < static_cast<Index>(diagonal.size()); ++v) triplets.emplace_back(v, v, added[v]);
    SparseMatrix matrix(hessian.rows(), hessian.cols());
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return hessian + matrix;
}

}  // namespace

VectorXd ConvexNewton::solve(SparseMatrix hessian, const VectorXd& right)
{
    const double scale = hessian.diagonal().cwiseAbs().mean();
    for (double shift = first_shift;; shift *= 1e2) {
        const SparseMatrix matrix = grounded(hessian, shift * scale);
        try {
            if (std::vector<Index> pattern = pattern_of(matrix); pattern != pattern_) {
                factor_.reset();
                pattern_ = std::move(pattern);
            }
            return factored(factor_, matrix).solve(right).col(0);
        } catch (const SolverError&) {
            // Collapsed faces leave the Hessian singular up to round-off.
            factor_.reset();
            if (shift >= last_shift) throw;
        }
    }
}

NewtonReport ConvexNewton::minimize(ConvexEnergy& energy, VectorXd& u, const NewtonOptions& options,
                                    ExecutionContext& context)
{
    NewtonReport report;
    VectorXd gradient = energy.gradient(u);
    while (true) {
        report.residuals.push_back(gradient.lpNorm<Eigen::Infinity>());
        report.converged = report.residuals.back() <= options.tolerance;
        if (report.converged) return report;
        if (report.steps == options.max_steps) {
            report.reason = "no convergence in " + std::to_string(report.steps) + " Newton steps";
            return report;
        }
        if (u.maxCoeff() - u.minCoeff() > widest_range) {
            report.reason = "the scale factors run away: nothing has this curvature";
            return report;
        }
        context.checkpoint();
        // H d = -g; H 1 = 0, so the mean of d is free, and taken as 0.
        VectorXd direction;
        try {
            direction = solve(energy.hessian(), -gradient);
        } catch (const SolverError&) {
            report.reason = "the Hessian is singular up to round-off";
            return report;
        }
        direction.array() -= direction.mean();
        // The energy has no closed form, but it is convex: along d its slope must not yet have turned to more than half
        // of what it was.
        const double slope = gradient.dot(direction);
        const double first = std::min(1.0, largest_change / std::max(direction.lpNorm<Eigen::Infinity>(), 1e-300));
        double step = first;
        VectorXd next;
        for (;; step *= 0.5) {
            if (!(slope < 0.0) || !(step > shortest_step * first)) {
                report.reason = "no step lowers the energy";
                return report;
            }
            next = energy.gradient(u + step * direction);
            if (next.allFinite() && next.dot(direction) <= -0.5 * slope) break;
        }
        u += step * direction;
        gradient = std::move(next);
        ++report.steps;
    }
}

}  // namespace koebe
