#include "sphere/spherical_balance.h"

#include "sphere/spherical_points.h"

#include <Eigen/Dense>

#include <cmath>

namespace koebe {
namespace {

constexpr int most_newton_steps = 200;
constexpr double farthest_step = 3.0;  // hyperbolic length
constexpr double balanced_gradient = 1e-9;
constexpr double least_gradient = 1e-15;

/// The end of a geodesic of the upper half-space from (0, 1), with a start direction given at the ball's centre.
PlaneSimilarity along_geodesic(const PlaneSimilarity& from, const SpherePoint& direction, double length)
{
    // (0, 0, 1) is the point 0 of the plane, so up in the half-space is down in the ball.
    const double reach = std::cosh(length) + direction[2] * std::sinh(length);
    const Complex across = Complex(direction[0], direction[1]) * (std::sinh(length) / reach);
    return {from.shift + from.scale * across, from.scale / reach};
}

/// Mean of the points, and half the Hessian of the unevenness, 2 (1 - x x').
SpherePoint mean_point(const VectorXcd& z, const VectorXd& weights, const PlaneSimilarity& move,
                       Eigen::Matrix3d& curved)
{
    SpherePoint mean = SpherePoint::Zero();
    curved = Eigen::Matrix3d::Zero();
    for (Eigen::Index v = 0; v < z.size(); ++v) {
        const SpherePoint x = on_sphere(move(z[v]));
        mean += weights[v] * x;
        curved -= weights[v] * x * x.transpose();
    }
    curved /= weights.sum();
    curved += Eigen::Matrix3d::Identity();
    return mean / weights.sum();
}

}  // namespace

double spherical_unevenness(const VectorXcd& z, const VectorXd& weights, const PlaneSimilarity& move)
{
    double sum = 0.0;
    for (Eigen::Index v = 0; v < z.size(); ++v)  // hypot: a far point must not overflow
        sum +=
            weights[v] * (2.0 * std::log(std::hypot(move.scale, std::abs(z[v] - move.shift))) - std::log(move.scale));
    return 2.0 * sum / weights.sum();
}

SphericalBalance balance_on_sphere(const VectorXcd& z, const VectorXd& weights)
{
    SphericalBalance result;
    if (z.size() == 0 || !(weights.sum() > 0.0)) return result;
    double now = spherical_unevenness(z, weights, result.move);
    for (int step = 0; step < most_newton_steps; ++step) {
        Eigen::Matrix3d curved;
        const SpherePoint mean = mean_point(z, weights, result.move, curved);
        result.gradient = mean.norm();
        if (!(result.gradient > least_gradient)) break;
        // With only two points there is no curvature between them: add a little.
        curved += 1e-12 * Eigen::Matrix3d::Identity();
        SpherePoint direction = curved.ldlt().solve(mean);
        if (!direction.allFinite() || !(direction.dot(mean) > 0.0)) direction = mean;
        double length = std::min(direction.norm(), farthest_step);
        direction.normalize();
        bool better = false;
        const bool near = result.gradient < 1e-6;  // steps must lessen the gradient, as rounding hides the rest
        for (int halving = 0; halving < 40 && !better; ++halving, length *= 0.5) {
            const PlaneSimilarity next = along_geodesic(result.move, direction, length);
            if (!(next.scale > 0.0) || !std::isfinite(next.scale)) continue;
            if (near) {
                Eigen::Matrix3d unused;
                better = mean_point(z, weights, next, unused).norm() < result.gradient;
            } else {
                const double then = spherical_unevenness(z, weights, next);
                better = then < now - 1e-4 * length * direction.dot(mean);
                if (better) now = then;
            }
            if (better) result.move = next;
        }
        if (!better) break;
    }
    result.balanced = result.gradient < balanced_gradient;
    return result;
}

}  // namespace koebe
