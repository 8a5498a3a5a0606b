#include "foldover/foldover_free.h"

#include "linear/sparse_cholesky.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace koebe {
namespace {

using Gradient = Eigen::Matrix<double, 6, 1>;
using Hessian = Eigen::Matrix<double, 6, 6>;
using Mobility = FoldoverProblem::Mobility;

constexpr double least_epsilon = 1e-6;  // Garanzha et al. 2021, section 3.2
constexpr double shift = 1e-9;          // of the Hessian's diagonal, over itself
constexpr double armijo = 1e-4;
constexpr int halvings = 24;
constexpr int patience = 30;  // iterations without a better worst determinant, while folded

class FoldoverMinimizer {
public:
    FoldoverMinimizer(FoldoverProblem& problem, const FoldoverOptions& options)
        : problem_(problem), options_(options), first_unknown_(problem.points.rows(), -1)
    {
        for (Eigen::Index v = 0; v < problem.points.rows(); ++v)
            if (problem.mobility[v] != Mobility::held) {
                first_unknown_[v] = unknowns_;
                unknowns_ += problem.mobility[v] == Mobility::free ? 2 : 1;
            }
        for (Eigen::Index f = 0; f < problem.triangles.rows(); ++f) {
            // J = E R^-1 in the entries of E; row-major (J00, J01, J10, J11) from (x0, y0, x1, y1, x2, y2).
            const Eigen::Matrix2d s = problem.reference[f].inverse();
            Eigen::Matrix<double, 4, 6> map = Eigen::Matrix<double, 4, 6>::Zero();
            for (int row = 0; row < 2; ++row)
                for (int column = 0; column < 2; ++column) {
                    map(2 * row + column, 2 + row) = s(0, column);
                    map(2 * row + column, 4 + row) = s(1, column);
                    map(2 * row + column, row) = -s(0, column) - s(1, column);
                }
            maps_.push_back(map);
        }
    }

    bool run(const ExecutionContext& context)
    {
        if (unknowns_ == 0) return worst_determinant(problem_.points) > 0.0;
        double best_worst = -std::numeric_limits<double>::infinity();
        int waited = 0;
        for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
            context.checkpoint();
            const double worst = worst_determinant(problem_.points);
            epsilon_ = std::sqrt(least_epsilon * least_epsilon + 0.04 * std::pow(std::min(worst, 0.0), 2));
            if (worst > best_worst + 1e-3 * std::abs(best_worst) || worst > 0.0) {
                best_worst = worst;
                waited = 0;
            } else if (++waited > patience) {
                break;
            }
            const double before = energy(problem_.points);
            if (!newton_step(before)) break;
            const double after = energy(problem_.points);
            if (worst > 0.0 && before - after < options_.settled * before) break;
        }
        return worst_determinant(problem_.points) > 0.0;
    }

private:
    Eigen::Vector4d jacobian(const PlanarPoints& points, Eigen::Index f) const
    {
        Gradient corners;
        for (int k = 0; k < 3; ++k) corners.segment<2>(2 * k) = points.row(problem_.triangles(f, k));
        // Relative to the first corner, so that nothing cancels.
        for (int k = 2; k >= 0; --k) corners.segment<2>(2 * k) -= corners.segment<2>(0).eval();
        return maps_[f] * corners;
    }

    double weight(Eigen::Index f) const { return problem_.weight.size() > 0 ? problem_.weight[f] : 1.0; }

    static double determinant(const Eigen::Vector4d& j) { return j[0] * j[3] - j[1] * j[2]; }

    double worst_determinant(const PlanarPoints& points) const
    {
        double worst = std::numeric_limits<double>::infinity();
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f)
            worst = std::min(worst, determinant(jacobian(points, f)) - problem_.floor[f]);
        return worst;
    }

    /// chi and its first two derivatives.
    Eigen::Vector3d regularized(double d) const
    {
        const double root = std::hypot(epsilon_, d);
        const double chi = d > 0.0 ? 0.5 * (d + root) : 0.5 * epsilon_ * epsilon_ / (root - d);
        return {chi, chi / root, 0.5 * epsilon_ * epsilon_ / (root * root * root)};
    }

    double excess(double term) const { return std::max(0.5 * term - 1.0, 0.0) + options_.slack; }

    /// What a face's term counts.
    double raised(double term) const { return options_.power == 1.0 ? term : std::pow(excess(term), options_.power); }

    double energy(const PlanarPoints& points) const
    {
        double sum = 0.0;
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            const Eigen::Vector4d j = jacobian(points, f);
            const double d = determinant(j);
            sum += weight(f) * raised((j.squaredNorm() + options_.area_weight * (d * d + 1.0)) /
                                      regularized(d - problem_.floor[f])[0]);
        }
        for (Eigen::Index v = 0; v < problem_.pull.size(); ++v)
            if (pulled(v)) sum += problem_.pull[v] * std::pow(offset(points, v).second, 2);
        return sum;
    }

    bool pulled(Eigen::Index v) const { return problem_.pull[v] > 0.0 && problem_.mobility[v] == Mobility::free; }

    bool to_centre(Eigen::Index v) const { return !problem_.pull_inside.empty() && problem_.pull_inside[v]; }

    /// The outward direction of a pulled vertex and its distance from the circle, or the centre, over the radius.
    std::pair<Eigen::Vector2d, double> offset(const PlanarPoints& points, Eigen::Index v) const
    {
        const Circle& circle = problem_.circles[v];
        const Eigen::Vector2d arm =
            points.row(v).transpose() - Eigen::Vector2d(circle.center.real(), circle.center.imag());
        const double distance = arm.norm();
        const double target = to_centre(v) ? 0.0 : 1.0;
        if (!(distance > 0.0)) return {Eigen::Vector2d::Zero(), -target};
        return {arm / distance, distance / circle.radius - target};
    }

    void derivatives(Eigen::Index f, Gradient& gradient, Hessian& hessian) const
    {
        const Eigen::Vector4d j = jacobian(problem_.points, f);
        const double d = determinant(j);
        const Eigen::Vector3d chi = regularized(d - problem_.floor[f]);
        const Eigen::Vector4d d_gradient(j[3], -j[2], -j[1], j[0]);
        Eigen::Matrix4d d_hessian = Eigen::Matrix4d::Zero();
        d_hessian(0, 3) = d_hessian(3, 0) = 1.0;
        d_hessian(1, 2) = d_hessian(2, 1) = -1.0;
        // The energy is N(J) / chi(D) with N = |J|^2 + theta (D^2 + 1).
        const double theta = options_.area_weight;
        const double n = j.squaredNorm() + theta * (d * d + 1.0);
        const Eigen::Vector4d n_gradient = 2.0 * j + 2.0 * theta * d * d_gradient;
        const double inverse = 1.0 / chi[0], slope = -chi[1] * inverse * inverse;
        const double bend = 2.0 * chi[1] * chi[1] * inverse * inverse * inverse - chi[2] * inverse * inverse;
        Eigen::Vector4d g = inverse * n_gradient + n * slope * d_gradient;
        Eigen::Matrix4d h = 2.0 * inverse * Eigen::Matrix4d::Identity() +
                            (2.0 * theta * inverse + n * bend) * d_gradient * d_gradient.transpose() +
                            (2.0 * theta * d * inverse + n * slope) * d_hessian +
                            slope * (n_gradient * d_gradient.transpose() + d_gradient * n_gradient.transpose());
        if (options_.power != 1.0) {
            const double t = excess(n * inverse), s = options_.power;
            const double first = 0.5 * s * std::pow(t, s - 1.0);
            h = first * h + 0.25 * s * (s - 1.0) * std::pow(t, s - 2.0) * g * g.transpose();
            g *= first;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(h);
        h = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
        gradient = weight(f) * (maps_[f].transpose() * g);
        hessian = weight(f) * (maps_[f].transpose() * h * maps_[f]);
    }

    /// The directions in which a vertex moves, as rows; none if it is held.
    Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 2, 2> directions(Index v) const
    {
        if (problem_.mobility[v] == Mobility::free) return Eigen::Matrix2d::Identity();
        Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 2, 2> tangent(problem_.mobility[v] == Mobility::held ? 0 : 1, 2);
        if (tangent.rows() == 0) return tangent;
        const Eigen::RowVector2d arm = problem_.points.row(v) - Eigen::RowVector2d(problem_.circles[v].center.real(),
                                                                                   problem_.circles[v].center.imag());
        tangent << -arm[1], arm[0];
        return tangent / arm.norm();
    }

    PlanarPoints moved(const VectorXd& step, double share) const
    {
        PlanarPoints result = problem_.points;
        for (Eigen::Index v = 0; v < result.rows(); ++v) {
            if (first_unknown_[v] < 0) continue;
            if (problem_.mobility[v] == Mobility::free) {
                result.row(v) += share * step.segment<2>(first_unknown_[v]).transpose();
            } else {
                const Circle& circle = problem_.circles[v];
                const Complex arm = Complex(result(v, 0), result(v, 1)) - circle.center;
                const double turn = share * step[first_unknown_[v]] / circle.radius;
                const Complex image = circle.center + std::polar(circle.radius, std::arg(arm) + turn);
                result.row(v) << image.real(), image.imag();
            }
        }
        return result;
    }

    /// A damped Newton step for the present epsilon; false if no step decreases the energy.
    bool newton_step(double before)
    {
        VectorXd gradient = VectorXd::Zero(unknowns_);
        entries_.clear();
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            Gradient g;
            Hessian h;
            derivatives(f, g, h);
            for (int a = 0; a < 3; ++a) {
                const Index v = problem_.triangles(f, a), row = first_unknown_[v];
                if (row < 0) continue;
                const auto rows = directions(v);
                gradient.segment(row, rows.rows()) += rows * g.segment<2>(2 * a);
                for (int b = 0; b < 3; ++b) {
                    const Index w = problem_.triangles(f, b), column = first_unknown_[w];
                    if (column < 0) continue;
                    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2> block =
                        rows * h.block<2, 2>(2 * a, 2 * b) * directions(w).transpose();
                    for (Index i = 0; i < block.rows(); ++i)
                        for (Index j = 0; j < block.cols(); ++j)
                            entries_.emplace_back(row + i, column + j, block(i, j));
                }
            }
        }
        for (Eigen::Index v = 0; v < problem_.pull.size(); ++v) {
            if (!pulled(v)) continue;
            const auto [outward, distance] = offset(problem_.points, v);
            const double weight = 2.0 * problem_.pull[v] / problem_.circles[v].radius;
            const Index row = first_unknown_[v];
            gradient.segment<2>(row) += weight * distance * outward;
            Eigen::Matrix2d block = outward * outward.transpose();
            if (to_centre(v)) block.setIdentity();
            block *= weight / problem_.circles[v].radius;
            for (Index i = 0; i < 2; ++i)
                for (Index j = 0; j < 2; ++j) entries_.emplace_back(row + i, row + j, block(i, j));
        }
        SparseMatrix hessian(unknowns_, unknowns_);
        hessian.setFromTriplets(entries_.begin(), entries_.end());
        for (Index i = 0; i < unknowns_; ++i) hessian.coeffRef(i, i) *= 1.0 + shift;
        VectorXd step = newton_direction(hessian, gradient);
        double slope = gradient.dot(step);
        if (!(slope < 0.0) || !step.allFinite()) {
            step = -gradient.cwiseQuotient(hessian.diagonal().cwiseMax(1e-300));
            slope = gradient.dot(step);
            if (!(slope < 0.0)) return false;
        }
        double share = 1.0;
        for (int i = 0; i < halvings; ++i, share *= 0.5) {
            PlanarPoints trial = moved(step, share);
            if (options_.strict && !(worst_determinant(trial) > 0.0)) continue;
            if (energy(trial) <= before + armijo * share * slope) {
                problem_.points = std::move(trial);
                return true;
            }
        }
        return false;
    }

    /// -H^-1 gradient, or 0 if H is singular.
    VectorXd newton_direction(const SparseMatrix& hessian, const VectorXd& gradient)
    {
        try {
            if (solver_)
                solver_->refactorize(hessian);
            else
                solver_.emplace(hessian);
            return -solver_->solve(gradient);
        } catch (const SolverError&) {
            solver_.reset();
            return VectorXd::Zero(unknowns_);
        }
    }

    FoldoverProblem& problem_;
    FoldoverOptions options_;
    std::vector<Index> first_unknown_;  // per vertex, -1 if held
    Index unknowns_ = 0;
    std::vector<Eigen::Matrix<double, 4, 6>> maps_;
    double epsilon_ = 1.0;
    std::vector<Eigen::Triplet<double, Index>> entries_;
    std::optional<SparseCholesky> solver_;
};

}  // namespace

bool minimize_foldover_free(FoldoverProblem& problem, const ExecutionContext& context, const FoldoverOptions& options)
{
    return FoldoverMinimizer(problem, options).run(context);
}

}  // namespace koebe
