#include "circles/point_alignment.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace koebe {
namespace {

double squares(const VectorXcd& points, const VectorXcd& targets, const VectorXd& weights)
{
    return (weights.array() * (points - targets).array().abs2()).sum();
}

/// The best rotation, which needs no start value.
Moebius nearest_turn(const VectorXcd& points, const VectorXcd& targets, const VectorXd& weights)
{
    const Complex overlap = (weights.array() * targets.array() * points.array().conjugate()).sum();
    return {0.0, std::abs(overlap) > 0.0 ? overlap / std::abs(overlap) : Complex(1.0)};
}

}  // namespace

Moebius nearest_automorphism(const VectorXcd& points, const VectorXcd& targets, const VectorXd& weights)
{
    constexpr int most_iterations = 50, most_halvings = 20;
    constexpr double least_step = 1e-12, longest_step = 0.5;  // of a and the angle, dimensionless
    Moebius best = nearest_turn(points, targets, weights);
    VectorXcd now = best(points);
    double sum = squares(now, targets, weights);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        // (z - a) / (1 - conj(a) z) turned by exp(i p) is z - a + conj(a) z^2 + i p z, to first order.
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d slope = Eigen::Vector3d::Zero();
        for (Eigen::Index v = 0; v < now.size(); ++v) {
            const Complex z = now[v], square = z * z, i(0.0, 1.0);
            const Complex by[] = {square - 1.0, -i * (square + 1.0), i * z};
            const Complex miss = z - targets[v];
            for (int r = 0; r < 3; ++r) {
                slope[r] += weights[v] * (std::conj(by[r]) * miss).real();
                for (int c = 0; c < 3; ++c) normal(r, c) += weights[v] * (std::conj(by[r]) * by[c]).real();
            }
        }
        Eigen::Vector3d step = -normal.ldlt().solve(slope);
        if (!step.allFinite()) break;
        if (step.norm() > longest_step) step *= longest_step / step.norm();
        bool better = false;
        for (int halving = 0; halving < most_halvings && !better && step.norm() > least_step; ++halving) {
            const Complex turn = std::polar(1.0, step[2]);
            const Moebius next = Moebius{{step[0], step[1]}, turn} * best;
            const VectorXcd there = next(points);
            const double sum_there = squares(there, targets, weights);
            better = sum_there < sum;
            if (better) {
                best = next;
                now = there;
                sum = sum_there;
            } else {
                step *= 0.5;
            }
        }
        if (!better) break;
    }
    return best;
}

}  // namespace koebe
