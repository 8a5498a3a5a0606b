#include "sphere/spherical_balance.h"

#include "execution/thread_share.h"
#include "sphere/spherical_points.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

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

/// The sum over pieces of the points, each added up by of_piece(begin, end, sum), in the order of the pieces.
template <class Sum, class OfPiece>
Sum sum_of_pieces(Eigen::Index count, Sum zero, const OfPiece& of_piece)
{
    constexpr std::size_t at_a_time = 16384;
    const std::size_t size = static_cast<std::size_t>(count);
    std::vector<Sum> pieces((size + at_a_time - 1) / at_a_time, zero);
    in_pieces(size, at_a_time, [&](std::size_t begin, std::size_t end) {
        of_piece(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end), pieces[begin / at_a_time]);
    });
    Sum sum = zero;
    for (const Sum& piece : pieces) sum += piece;
    return sum;
}

/// Mean of the points, and half the Hessian of the unevenness, 2 (1 - x x').
SpherePoint mean_point(const VectorXcd& z, const VectorXd& weights, const PlaneSimilarity& move,
                       Eigen::Matrix3d& curved)
{
    using Moments = Eigen::Matrix<double, 10, 1>;  // w, w x, and the lower triangle of w x x'
    const Moments sum =
        sum_of_pieces(z.size(), Moments(Moments::Zero()), [&](auto begin, auto end, Moments& sum_of_piece) {
            double sw = 0.0, sx = 0.0, sy = 0.0, sz = 0.0, xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
            for (Eigen::Index v = begin; v < end; ++v) {
                // on_sphere to within rounding of the unit sphere, without branches; a far point has share 0.
                const double re = (z[v].real() - move.shift.real()) / move.scale;
                const double im = (z[v].imag() - move.shift.imag()) / move.scale;
                const double share = 2.0 / (1.0 + re * re + im * im);
                const double a = share * re, b = share * im, c = share - 1.0, w = weights[v];
                const double wa = w * a, wb = w * b, wc = w * c;
                sw += w;
                sx += wa;
                sy += wb;
                sz += wc;
                xx += wa * a;
                xy += wa * b;
                xz += wa * c;
                yy += wb * b;
                yz += wb * c;
                zz += wc * c;
            }
            sum_of_piece << sw, sx, sy, sz, xx, xy, xz, yy, yz, zz;
        });
    curved << sum[4], sum[5], sum[6], sum[5], sum[7], sum[8], sum[6], sum[8], sum[9];
    curved = Eigen::Matrix3d::Identity() - curved / sum[0];
    return sum.segment<3>(1) / sum[0];
}

}  // namespace

double spherical_unevenness(const VectorXcd& z, const VectorXd& weights, const PlaneSimilarity& move)
{
    const double sum = sum_of_pieces(z.size(), 0.0, [&](auto begin, auto end, double& sum_of_piece) {
        for (Eigen::Index v = begin; v < end; ++v) {
            const Complex at = z[v] - move.shift;
            const double square = move.scale * move.scale + std::norm(at);
            const bool in_range = square > 1e-290 && square < 1e300;  // squares of far points overflow
            sum_of_piece +=
                weights[v] * (in_range ? std::log(square) : 2.0 * std::log(std::hypot(move.scale, std::abs(at))));
        }
    });
    return 2.0 * (sum / weights.sum() - std::log(move.scale));
}

SphericalBalance balance_on_sphere(const VectorXcd& z, const VectorXd& weights)
{
    SphericalBalance result;
    if (z.size() == 0 || !(weights.sum() > 0.0)) return result;
    Eigen::Matrix3d curved;
    SpherePoint mean = mean_point(z, weights, result.move, curved);
    for (int step = 0; step < most_newton_steps; ++step) {
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
        const int most_halvings = result.gradient < 1e-12 ? 1 : 40;  // rounding hides this gradient too
        const double slope = direction.dot(mean);
        for (int halving = 0; halving < most_halvings && !better; ++halving, length *= 0.5) {
            const PlaneSimilarity next = along_geodesic(result.move, direction, length);
            if (!(next.scale > 0.0) || !std::isfinite(next.scale)) continue;
            Eigen::Matrix3d curved_there;
            const SpherePoint there = mean_point(z, weights, next, curved_there);
            // A step that halves the gradient needs no other test: such steps end where it is 0.
            better = there.norm() < (near ? 1.0 : 0.5) * result.gradient ||
                     (!near && spherical_unevenness(z, weights, next) <
                                   spherical_unevenness(z, weights, result.move) - 1e-4 * length * slope);
            if (!better) continue;
            result.move = next;
            mean = there;
            curved = curved_there;
        }
        if (!better) break;
    }
    result.balanced = result.gradient < balanced_gradient;
    return result;
}

}  // namespace koebe
