#include "baselines/circle_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr double least_radius = 1e-9;  // of the mean edge: the radius at a vertex of a collapsed face

}  // namespace

CirclePacking circle_packing(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count, Packing kind)
{
    const bool acute = kind == Packing::acute;
    VectorXd radii = VectorXd::Constant(vertex_count, acute ? 0.0 : std::numeric_limits<double>::infinity());
    VectorXd corners = VectorXd::Zero(vertex_count);
    // In a face with lengths l_ij, circles that touch have the radius (l_ij + l_ik - l_jk) / 2: their mean at a vertex
    // (acute), or the smallest (inversive).
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double radius = 0.5 * (lengths(f, k) + lengths(f, (k + 2) % 3) - lengths(f, (k + 1) % 3));
            double& own = radii[triangles(f, k)];
            own = acute ? own + radius : std::min(own, radius);
            ++corners[triangles(f, k)];
        }
    const double least = least_radius * lengths.mean();
    for (Index v = 0; v < vertex_count; ++v)
        radii[v] = corners[v] == 0.0 ? 1.0 : std::max(acute ? radii[v] / corners[v] : radii[v], least);

    // Inversive distance of an edge: eta = (l^2 - a^2 - b^2) / 2ab, here without cancellation.
    CirclePacking packing{radii.array().log(), EdgeLengths(lengths.rows(), 3), 0.0};
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double a = radii[triangles(f, k)], b = radii[triangles(f, (k + 1) % 3)], l = lengths(f, k);
            const double eta = ((l - a - b) * (l + a + b) / (2.0 * a * b)) + 1.0;
            packing.weights(f, k) = acute ? std::clamp(eta, 0.0, 1.0) : std::max(eta, 0.0);
        }
    packing.changed =
        (packing_lengths(triangles, packing, packing.log_radii).array() / lengths.array() - 1.0).abs().maxCoeff();
    return packing;
}

EdgeLengths packing_lengths(const Triangles& triangles, const CirclePacking& packing, const VectorXd& log_radii)
{
    const VectorXd radii = log_radii.array().exp();
    EdgeLengths lengths(triangles.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double a = radii[triangles(f, k)], b = radii[triangles(f, (k + 1) % 3)];
            lengths(f, k) = std::sqrt((a + b) * (a + b) + 2.0 * a * b * (packing.weights(f, k) - 1.0));
        }
    return lengths;
}

EdgeLengths power_weights(const Triangles& triangles, const EdgeLengths& lengths, const VectorXd& log_radii)
{
    const VectorXd squares = (2.0 * log_radii).array().exp();
    EdgeLengths weights = EdgeLengths::Zero(triangles.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const double area = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
        if (!(area > 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            const double c = lengths(f, k), a = lengths(f, (k + 1) % 3), b = lengths(f, (k + 2) % 3);
            const double own = squares[triangles(f, k)];
            // Feet of the radical axes, measured from the corner at the half-edge's origin.
            const double along = (c * c + own - squares[triangles(f, (k + 1) % 3)]) / (2.0 * c);
            const double across = (b * b + own - squares[triangles(f, (k + 2) % 3)]) / (2.0 * b);
            const double sine = 2.0 * area / (b * c), cosine = (b * b + (c - a) * (c + a)) / (2.0 * b * c);
            weights(f, k) = (across - along * cosine) / sine / c;
        }
    }
    return weights;
}

}  // namespace koebe
