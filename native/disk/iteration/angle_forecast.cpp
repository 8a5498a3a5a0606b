#include "iteration/angle_forecast.h"

#include "core/length.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_known = 3;      // shapes: enough for a parabola
constexpr Eigen::Index sampled = 2000;     // faces, about
constexpr double shortest = 1e-12;         // edge, in units of the surface
constexpr double independent = 1e-5;       // share of a shape's difference that must be new, or the shape adds nothing
constexpr double most_left = 0.5;          // share of the distance from the last shape that a forecast may leave
constexpr double least = 0.5, most = 2.0;  // ratio of a step along a loop to the last one

/// Shifts a loop's angles by whole turns, so that they begin within half a turn of others.
VectorXd beside(const VectorXd& angles, const VectorXd& others)
{
    constexpr double turn = 2.0 * std::numbers::pi;
    return angles.array() - turn * std::round((angles[0] - others[0]) / turn);
}

bool near_to(const VectorXd& angles, const VectorXd& last)
{
    constexpr double turn = 2.0 * std::numbers::pi;
    for (Eigen::Index b = 0, m = angles.size(); b < m; ++b) {
        const double close = b + 1 == m ? turn : 0.0;
        const double step = angles[(b + 1) % m] + close - angles[b], before = last[(b + 1) % m] + close - last[b];
        if (!(step > least * before && step < most * before)) return false;
    }
    return true;
}

}  // namespace

VectorXd AngleForecast::shape_of(const Vertices& vertices, const Triangles& triangles)
{
    const Eigen::Index stride = std::max<Eigen::Index>(1, triangles.rows() / sampled);
    const Eigen::Index count = (triangles.rows() + stride - 1) / stride;
    VectorXd shape(3 * count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(i * stride, k), b = triangles(i * stride, (k + 1) % 3);
            shape[3 * i + k] = std::log(std::max(length_of(vertices.row(b) - vertices.row(a)), shortest));
        }
    return shape.array() - shape.mean();
}

void AngleForecast::add(VectorXd shape, std::vector<VectorXd> angles)
{
    if (!known_.empty() && known_.back().angles.size() != angles.size()) known_.clear();
    if (known_.size() == most_known) known_.erase(known_.begin());
    known_.push_back({std::move(shape), std::move(angles)});
}

std::vector<VectorXd> AngleForecast::angles_for(const VectorXd& shape) const
{
    if (known_.empty()) return {};
    const Known& last = known_.back();
    const Eigen::Index others = static_cast<Eigen::Index>(known_.size()) - 1;
    if (others == 0 || shape.size() != last.shape.size()) return last.angles;
    MatrixXd differences(shape.size(), others);
    for (Eigen::Index j = 0; j < others; ++j) differences.col(j) = known_[j].shape - last.shape;
    const VectorXd way = shape - last.shape;
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> system;
    system.setThreshold(independent);
    const VectorXd shares = system.compute(differences).solve(way);
    if (!((way - differences * shares).norm() <= most_left * way.norm())) return last.angles;
    std::vector<VectorXd> result = last.angles;
    for (std::size_t k = 0; k < result.size(); ++k) {
        for (Eigen::Index j = 0; j < others; ++j)
            result[k] += shares[j] * (beside(known_[j].angles[k], last.angles[k]) - last.angles[k]);
        if (!near_to(result[k], last.angles[k])) return last.angles;
    }
    return result;
}

}  // namespace koebe
