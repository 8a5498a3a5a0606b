#include "circles/boundary_angles.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

using std::numbers::pi;

constexpr double shortest_step = 1e-5;  // of the mean step, dimensionless
constexpr int newton_steps = 200;
constexpr double longest_newton_step = 0.7;  // keeps a damped step inside the disk

/// Makes angles increasing, each in [previous, previous + 2 pi). Starts from the principal value of the first.
VectorXd unrolled(const VectorXcd& points)
{
    VectorXd angles(points.size());
    angles[0] = std::arg(points[0]);
    for (Eigen::Index b = 1; b < points.size(); ++b) angles[b] = angles[b - 1] + std::arg(points[b] / points[b - 1]);
    return angles;
}

/// The mean density along the edge from node b. On even loops it is the mean of the cubic through four nodes, on ragged
/// loops of the straight line through two, and in between a mixture.
double mean_density(const VectorXd& density, const VectorXd& edges, Eigen::Index b)
{
    constexpr double even = 2.0, ragged = 3.0;  // largest over least edge or density
    const Eigen::Index m = density.size(), before = (b + m - 1) % m, next = (b + 1) % m, after = (b + 2) % m;
    const auto [least, most] = std::minmax({density[before], density[b], density[next], density[after]});
    const auto [shortest, longest] = std::minmax({edges[before], edges[b], edges[next]});
    const double straight = 0.5 * (density[b] + density[next]);
    if (!(least > 0.0)) return straight;
    const double unevenness = std::max(most / least, longest / shortest);
    const double share = std::clamp((ragged - unevenness) / (ragged - even), 0.0, 1.0);
    return straight - share * (density[before] - density[b] - density[next] + density[after]) / 24.0;
}

}  // namespace

VectorXcd unit_circle_points(const VectorXd& angles)
{
    VectorXcd points(angles.size());
    for (Eigen::Index b = 0; b < angles.size(); ++b) points[b] = std::polar(1.0, angles[b]);
    return points;
}

VectorXd arc_length_angles(const VectorXd& edges)
{
    VectorXd angles(edges.size());
    const double length = edges.sum();
    double walked = 0.0;
    for (Eigen::Index b = 0; b < edges.size(); ++b) {
        angles[b] = 2.0 * pi * walked / length;
        walked += edges[b];
    }
    return angles;
}

VectorXd vertex_weights(const VectorXd& edges)
{
    const Eigen::Index m = edges.size();
    VectorXd weights(m);
    for (Eigen::Index b = 0; b < m; ++b) weights[b] = 0.5 * (edges[(b + m - 1) % m] + edges[b]);
    return weights / weights.sum();
}

VectorXd angles_from_flux(const VectorXd& flux, const VectorXd& edges, int& raised)
{
    const Eigen::Index m = flux.size();
    const double total = flux.sum();
    if (!(std::abs(total) > 0.0) || !std::isfinite(total))
        throw SolverError("no flux runs through a boundary loop: the surface is almost torn off there");
    VectorXd density(m);
    for (Eigen::Index b = 0; b < m; ++b) density[b] = flux[b] / (0.5 * (edges[(b + m - 1) % m] + edges[b])) / total;
    const double least = shortest_step * 2.0 * pi / static_cast<double>(m);
    VectorXd step(m);  // from node b to node b + 1
    for (Eigen::Index b = 0; b < m; ++b) {
        step[b] = 2.0 * pi * edges[b] * mean_density(density, edges, b);
        if (!(step[b] > least)) {
            step[b] = least;
            ++raised;
        }
    }
    return arc_length_angles(step);
}

VectorXd centered_angles(const VectorXd& angles, const VectorXd& weights, const VectorXd& reference)
{
    VectorXcd z = unit_circle_points(angles);
    for (int step = 0; step < newton_steps; ++step) {
        // (z - a) / (1 - conj(a) z) = z - a + conj(a) z^2 + ..., so its mean vanishes to first order for
        // a - conj(a) h = g with g and h the means of z and z^2.
        const Complex g = (weights.array() * z.array()).sum();
        if (std::abs(g) < 1e-15) break;
        const Complex h = (weights.array() * z.array().square()).sum();
        Complex a = (g + h * std::conj(g)) / std::max(1.0 - std::norm(h), 1e-12);
        if (std::abs(a) > longest_newton_step) a *= longest_newton_step / std::abs(a);
        z = ((z.array() - a) / (1.0 - std::conj(a) * z.array())).matrix();
        z.array() /= z.array().abs().cast<Complex>();
    }
    Complex turn = std::conj(z[0]);
    if (reference.size() == z.size()) {
        const Complex overlap = (weights.array() * unit_circle_points(reference).array() * z.array().conjugate()).sum();
        if (std::abs(overlap) > 0.0) turn = overlap / std::abs(overlap);
    }
    z *= turn;
    return unrolled(z);
}

}  // namespace koebe
