#include "circles/circle_fit.h"

#include <Eigen/Dense>

#include <cmath>

namespace koebe {
namespace {

constexpr int gauss_newton_steps = 20;       // upper bound: near a circle four or five are enough
constexpr double least_cosine = 0.92387953;  // cosine of a sixteenth of a turn, to either side of the mean
constexpr double gauss_newton_stop = 1e-15;  // relative to the radius

/// Least squares on |v|^2 - 2 v.c + (|c|^2 - r^2) = 0, centred and scaled first.
bool fit_circle_algebraic(const VectorXcd& points, Circle& circle)
{
    const Complex mean = points.mean();
    const double scale = std::sqrt((points.array() - mean).abs2().mean());
    if (!(scale > 0.0)) return false;
    MatrixXd system(points.size(), 3);
    VectorXd right(points.size());
    for (Eigen::Index i = 0; i < points.size(); ++i) {
        const Complex v = (points[i] - mean) / scale;
        system.row(i) << v.real(), v.imag(), 1.0;
        right[i] = std::norm(v);
    }
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(system);
    if (qr.rank() < 3) return false;
    const Eigen::Vector3d x = qr.solve(right);
    const Complex center(0.5 * x[0], 0.5 * x[1]);
    const double radius_squared = x[2] + std::norm(center);
    if (!(radius_squared > 0.0)) return false;
    circle = {mean + scale * center, scale * std::sqrt(radius_squared)};
    return true;
}

/// Whether all points lie within an eighth of a turn of the circle: then no loop goes round it.
bool spans_an_arc_only(const VectorXcd& points, const Circle& circle)
{
    const Complex direction = points.mean() - circle.center;
    for (const Complex& point : points) {
        const Complex arm = point - circle.center;
        if (!((arm * std::conj(direction)).real() > least_cosine * std::abs(arm) * std::abs(direction))) return false;
    }
    return true;
}

}  // namespace

VectorXcd gather_loop(const VectorXcd& positions, const VertexLoop& loop)
{
    VectorXcd points(static_cast<Eigen::Index>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i) points[static_cast<Eigen::Index>(i)] = positions[loop[i]];
    return points;
}

VectorXd length_weights(const VectorXcd& points)
{
    const Eigen::Index n = points.size();
    VectorXd weights = VectorXd::Zero(n);
    double length = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index next = (i + 1) % n;
        const double edge = std::abs(points[next] - points[i]);
        weights[i] += 0.5 * edge;
        weights[next] += 0.5 * edge;
        length += edge;
    }
    if (!(length > 0.0)) return VectorXd::Constant(n, 1.0 / static_cast<double>(n));
    return weights / length;
}

Circle fit_circle_paper(const VectorXcd& points)
{
    const VectorXd weights = length_weights(points);
    const Complex center = (weights.array() * points.array()).sum();
    return {center, (points.array() - center).abs().mean()};
}

Circle fit_circle_least_squares(const VectorXcd& points)
{
    Circle circle;
    if (points.size() < 3 || !fit_circle_algebraic(points, circle)) return fit_circle_paper(points);
    for (int step = 0; step < gauss_newton_steps; ++step) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (Eigen::Index i = 0; i < points.size(); ++i) {
            const Complex arm = points[i] - circle.center;
            const double distance = std::abs(arm);
            if (!(distance > 0.0)) continue;
            const Eigen::Vector3d row(-arm.real() / distance, -arm.imag() / distance, -1.0);
            normal += row * row.transpose();
            gradient += row * (distance - circle.radius);
        }
        const Eigen::Vector3d change = -normal.ldlt().solve(gradient);
        if (!change.allFinite()) break;
        circle.center += Complex(change[0], change[1]);
        circle.radius += change[2];
        if (change.norm() <= gauss_newton_stop * std::abs(circle.radius)) break;
    }
    return circle.radius > 0.0 && !spans_an_arc_only(points, circle) ? circle : fit_circle_paper(points);
}

double paper_roundness(const VectorXcd& points)
{
    if (points.size() == 0) return 0.0;
    const Circle circle = fit_circle_paper(points);
    if (circle.radius == 0.0) return 1.0;
    const auto deviation = (points.array() - circle.center).abs() - circle.radius;
    return std::sqrt(deviation.square().mean()) / circle.radius;
}

double deviation_from(const Circle& circle, const VectorXcd& points)
{
    const VectorXd weights = length_weights(points);
    const auto deviation = (points.array() - circle.center).abs() - circle.radius;
    return std::sqrt((weights.array() * deviation.square()).sum()) / circle.radius;
}

Roundness roundness(const VectorXcd& points, const Circle& circle)
{
    return {paper_roundness(points), deviation_from(circle, points)};
}

MeanRoundness mean_roundness(const std::vector<Roundness>& loops)
{
    MeanRoundness mean;
    const auto share = [](std::size_t count) { return count > 0 ? 1.0 / static_cast<double>(count) : 0.0; };
    const double of_all = share(loops.size()), of_holes = share(loops.empty() ? 0 : loops.size() - 1);
    for (std::size_t k = 0; k < loops.size(); ++k) {
        mean.all.paper += of_all * loops[k].paper;
        mean.all.least_squares += of_all * loops[k].least_squares;
        if (k == 0) continue;
        mean.holes.paper += of_holes * loops[k].paper;
        mean.holes.least_squares += of_holes * loops[k].least_squares;
    }
    return mean;
}

double inversive_distance(const Circle& a, const Circle& b)
{
    return std::abs(a.radius * a.radius + b.radius * b.radius - std::norm(a.center - b.center)) /
           (2.0 * a.radius * b.radius);
}

}  // namespace koebe
