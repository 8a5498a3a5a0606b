#include "surface/curvature_weights.h"

#include "core/connectivity.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double flat = 1e-12;   // radians: defects below it are rounding
constexpr double coarse = 0.01;  // K d^2 / 12: a surface that bends as much from face to face is not sampled

/// 1 for each vertex on a boundary edge.
std::vector<char> rim_of(const IntrinsicMetric& metric, Index vertex_count)
{
    std::vector<char> rim(vertex_count, 0);
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h)
        if (metric.twin[h] == no_twin) rim[origin(metric.triangles, h)] = rim[target(metric.triangles, h)] = 1;
    return rim;
}

/// The sum of some angles below pi.
struct AngleSum {
    Complex direction = 1.0;
    int full_turns = 0;

    void add(double cotangent)
    {
        const bool was_below = direction.imag() < 0.0;
        const double sine = 1.0 / std::sqrt(cotangent * cotangent + 1.0);
        direction = sine * Complex(direction.real() * cotangent - direction.imag(),
                                   direction.real() + direction.imag() * cotangent);
        full_turns += was_below && direction.imag() >= 0.0;
    }

    /// The sine of what is missing to a full turn; 1 where more than a right angle is missing, -1 where it is too much.
    double sine_of_defect() const
    {
        const bool near = direction.real() > 0.0 && full_turns == (direction.imag() < 0.0 ? 0 : 1);
        if (!near) return full_turns == 0 ? 1.0 : -1.0;
        return std::abs(direction.imag()) < flat ? 0.0 : -direction.imag();
    }
};

/// (V) the sines of the angle defects.
VectorXd defect_sines(const Triangles& triangles, Index vertex_count, const EdgeLengths& half_cotangents)
{
    std::vector<AngleSum> sums(vertex_count);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        sums[origin(triangles, previous_halfedge(h))].add(2.0 * half_cotangents.data()[h]);
    VectorXd sines(vertex_count);
    for (Index v = 0; v < vertex_count; ++v) sines[v] = sums[v].sine_of_defect();
    return sines;
}

/// (V) the areas of the circumcentric cells (Desbrun et al. 2005), from half_cotangents. The diagonal between two faces
/// on one circle adds nothing to them, so they do not depend on which diagonal rounding has chosen.
VectorXd circumcentric_areas(const IntrinsicMetric& metric, Index vertex_count, const EdgeLengths& half_cotangents)
{
    VectorXd areas = VectorXd::Zero(vertex_count);
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h) {
        const double length = metric.lengths.data()[h];
        const double share = 0.25 * half_cotangents.data()[h] * length * length;
        areas[origin(metric.triangles, h)] += share;
        areas[target(metric.triangles, h)] += share;
    }
    return areas;
}

/// A correction, which vanishes where it is not small: there the angle defects are noise or a crease.
double faded(double correction)
{
    const double ratio = correction / coarse;
    return correction / (1.0 + ratio * ratio * ratio * ratio);
}

/// Gives each vertex of the rim the mean of its inner neighbours.
void continue_to_rim(const IntrinsicMetric& metric, const std::vector<char>& rim, VectorXd& curvature)
{
    VectorXd sum = VectorXd::Zero(curvature.size()), count = sum;
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h) {
        const Index i = origin(metric.triangles, h), j = target(metric.triangles, h);
        for (const auto& [on, inside] : {std::pair(i, j), std::pair(j, i)})
            if (rim[on] && !rim[inside]) {
                sum[on] += curvature[inside];
                count[on] += 1.0;
            }
    }
    for (Index v = 0; v < static_cast<Index>(curvature.size()); ++v)
        if (rim[v]) curvature[v] = count[v] > 0.0 ? sum[v] / count[v] : 0.0;
}

}  // namespace

void correct_for_curvature(const IntrinsicMetric& metric, Index vertex_count, EdgeLengths& weights)
{
    const std::vector<char> rim = rim_of(metric, vertex_count);
    VectorXd curvature = defect_sines(metric.triangles, vertex_count, weights);
    const VectorXd areas = circumcentric_areas(metric, vertex_count, weights);
    for (Index v = 0; v < vertex_count; ++v)
        curvature[v] = rim[v] == 0 && areas[v] > 0.0 ? curvature[v] / areas[v] : 0.0;
    continue_to_rim(metric, rim, curvature);
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h) {
        const double length = metric.lengths.data()[h];
        const double mean = 0.5 * (curvature[origin(metric.triangles, h)] + curvature[target(metric.triangles, h)]);
        weights.data()[h] *= 1.0 + faded(mean * length * length / 12.0);
    }
}

EdgeLengths curvature_weights(const IntrinsicMetric& metric, Index vertex_count)
{
    EdgeLengths weights = half_cotangents(metric.lengths);
    correct_for_curvature(metric, vertex_count, weights);
    return weights;
}

}  // namespace koebe
