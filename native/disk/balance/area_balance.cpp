#include "balance/area_balance.h"

#include "surface/importance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr int most_steps = 40;
constexpr int most_halvings = 6;
constexpr double longest_step = 0.8;        // keeps a damped step inside the disk
constexpr double least_gain = 1e-7;         // relative fall of the distortion in a step
constexpr double weight_of_the_mean = 0.1;  // squared mean against variance

struct Spread {
    double mean, variance;

    explicit Spread(const FaceScales& scales)
    {
        const double total = scales.weights.sum();
        mean = scales.weights.dot(scales.log_ratio) / total;
        variance = scales.weights.dot((scales.log_ratio.array() - mean).square().matrix()) / total;
    }
    double distortion() const { return std::sqrt(variance + weight_of_the_mean * mean * mean); }
};

FaceScales scales_after(const FaceScales& scales, const Moebius& map)
{
    FaceScales result = scales;
    result.centers = map(scales.centers);
    result.log_ratio.array() +=
        2.0 * std::log(1.0 - std::norm(map.a)) - 4.0 * (1.0 - std::conj(map.a) * scales.centers.array()).abs().log();
    return result;
}

}  // namespace

FaceScales face_scales(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv, Eigen::Index most,
                       const VectorXd& importance)
{
    const VectorXd factors = importance.size() > 0 ? importance_factors(triangles, importance) : VectorXd();
    const Eigen::Index stride = std::max<Eigen::Index>(1, triangles.rows() / most);
    std::vector<Complex> centers;
    std::vector<double> log_ratio, weights;
    double whole = 0.0;
    // log(area in the UVs / area on the surface) of a sample of faces. The whole area is that of all faces.
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const auto corner = [&](int c) { return Complex(uv(triangles(f, c), 0), uv(triangles(f, c), 1)); };
        const Eigen::RowVector3d e1 = vertices.row(triangles(f, 1)) - vertices.row(triangles(f, 0));
        const Eigen::RowVector3d e2 = vertices.row(triangles(f, 2)) - vertices.row(triangles(f, 0));
        const double area = 0.5 * e1.cross(e2).norm() * (factors.size() > 0 ? factors[f] : 1.0);
        whole += area;
        if (f % stride != 0) continue;
        const double uv_area = 0.5 * std::imag(std::conj(corner(1) - corner(0)) * (corner(2) - corner(0)));
        if (!(area > 0.0) || !(uv_area > 0.0)) continue;
        centers.push_back((corner(0) + corner(1) + corner(2)) / 3.0);
        log_ratio.push_back(std::log(uv_area / area));
        weights.push_back(area);
    }
    // Relative to a map that keeps areas: there the ratio is pi / whole.
    const Eigen::Index count = static_cast<Eigen::Index>(centers.size());
    for (double& ratio : log_ratio) ratio -= std::log(std::numbers::pi / whole);
    return {Eigen::Map<VectorXcd>(centers.data(), count), Eigen::Map<VectorXd>(log_ratio.data(), count),
            Eigen::Map<VectorXd>(weights.data(), count)};
}

Moebius least_area_distortion(const FaceScales& scales, double& distortion)
{
    Moebius total;
    distortion = 0.0;
    if (scales.weights.size() == 0) return total;
    FaceScales now = scales;
    const Spread before(scales);
    Spread spread = before;
    distortion = spread.distortion();
    for (int step = 0; step < most_steps; ++step) {
        // 2 log |f'| = 4 Re(conj(a) z) to first order.
        Eigen::MatrixX2d slope(now.centers.size(), 2);
        slope << 4.0 * now.centers.real(), 4.0 * now.centers.imag();
        const double weight = now.weights.sum();
        const Eigen::RowVector2d mean_slope = now.weights.transpose() * slope / weight;
        slope.rowwise() -= mean_slope;
        const Eigen::Matrix2d normal = slope.transpose() * now.weights.asDiagonal() * slope / weight +
                                       weight_of_the_mean * mean_slope.transpose() * mean_slope;
        const Eigen::Vector2d a =
            -normal.ldlt().solve(slope.transpose() * now.weights.cwiseProduct(now.log_ratio) / weight +
                                 weight_of_the_mean * spread.mean * mean_slope.transpose());
        Complex move(a[0], a[1]);
        if (!std::isfinite(std::abs(move))) break;
        if (std::abs(move) > longest_step) move *= longest_step / std::abs(move);
        double gain = 0.0;
        for (int halving = 0; halving < most_halvings && gain <= 0.0; ++halving, move *= 0.5) {
            const Moebius map{move, Complex(1.0, 0.0)};
            FaceScales next = scales_after(now, map);
            const Spread next_spread(next);
            gain = distortion - next_spread.distortion();
            if (gain <= 0.0) continue;
            spread = next_spread;
            distortion = spread.distortion();
            now = std::move(next);
            total = map * total;
        }
        if (gain <= least_gain * distortion) break;
    }
    if (spread.variance > before.variance) {
        distortion = before.distortion();
        return {};
    }
    return total;
}

}  // namespace koebe
