#include "transfer/landmark_alignment.h"

#include "circles/point_alignment.h"
#include "core/numbering.h"
#include "transfer/landmark_map.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace koebe {
namespace {

constexpr double least_depth = 1e-6;               // lengths in the disk: distance of inner points from the unit circle
constexpr int most_rounds = 50;                    // limit for the barycentre
constexpr double centered = 1e-9;                  // lengths in the disk: distance of the barycentre from 0
constexpr Eigen::Index most_landmark_starts = 32;  // number of landmarks that are starts

bool is_inside(Complex z) { return std::abs(z) < 1.0 - least_depth; }

/// The rotation z -> turn z that takes points nearest to targets.
Moebius nearest_turn(const VectorXcd& points, const VectorXcd& targets)
{
    const Complex overlap = (targets.array() * points.array().conjugate()).sum();
    return {0.0, std::abs(overlap) > 0.0 ? overlap / std::abs(overlap) : Complex(1.0)};
}

/// The automorphism that takes the conformal barycentre of points to 0. A single point on the rim
/// has none.
Moebius centering(const VectorXcd& points)
{
    constexpr double longest_step = 0.9;
    Moebius map;
    for (int round = 0; round < most_rounds; ++round) {
        const Complex mean = map(points).mean();
        if (std::abs(mean) < centered) break;
        if (!(std::abs(mean) < 1.0 - least_depth)) return {};
        map = Moebius{std::abs(mean) > longest_step ? longest_step * mean / std::abs(mean) : mean} * map;
    }
    return map;
}

/// Takes one point exactly onto its target, then turns about it to bring the others near.
Moebius about_point(const VectorXcd& points, const VectorXcd& targets, Eigen::Index i)
{
    const Moebius from{points[i]}, to{targets[i]};
    return to.inverse() * nearest_turn(from(points), to(targets)) * from;
}

using Three = std::array<Complex, 3>;

/// (z - z0) (z1 - z2) / ((z - z2) (z1 - z0)) as a matrix.
Eigen::Matrix2cd to_standard(const Three& z)
{
    Eigen::Matrix2cd map;
    map << z[1] - z[2], -z[0] * (z[1] - z[2]), z[1] - z[0], -z[2] * (z[1] - z[0]);
    return map;
}

/// Takes three points of the unit circle onto three others; nothing if these run the other way round.
std::optional<Moebius> through_three(const Three& from, const Three& to)
{
    const Eigen::Matrix2cd map = to_standard(to).inverse() * to_standard(from);
    const Complex a = -map(0, 1) / map(0, 0);
    if (!(std::abs(a) < 1.0)) return {};
    const Moebius whole{a, 1.0};
    const Complex turn = to[0] / whole(from[0]);
    return Moebius{a, turn / std::abs(turn)};
}

/// Takes points of the rim exactly onto their targets: three far apart, or two and the middles between them.
std::optional<Moebius> about_rim(const VectorXcd& points, const VectorXcd& targets)
{
    std::vector<Eigen::Index> order = numbers_below<Eigen::Index>(points.size());
    std::ranges::sort(order, {}, [&](Eigen::Index i) { return std::arg(points[i]); });
    const auto unit = [](Complex z) { return z / std::abs(z); };
    Three from, to;
    if (points.size() == 2) {
        const auto middle = [](Complex a, Complex b) {
            const double turn = std::arg(b / a);
            return a * std::polar(1.0, 0.5 * (turn > 0.0 ? turn : turn + 2.0 * std::numbers::pi));
        };
        from = {unit(points[0]), unit(points[1]), {}};
        to = {unit(targets[0]), unit(targets[1]), {}};
        from[2] = middle(from[0], from[1]);
        to[2] = middle(to[0], to[1]);
    } else {
        const auto third = static_cast<double>(order.size()) / 3.0;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Index i = order[static_cast<std::size_t>(k * third)];
            from[k] = unit(points[i]);
            to[k] = unit(targets[i]);
        }
    }
    return through_three(from, to);
}

std::vector<Moebius> starts(const VectorXcd& points, const VectorXcd& targets)
{
    std::vector<Moebius> maps{nearest_turn(points, targets)};
    std::vector<Eigen::Index> inside, rim;
    for (Eigen::Index i = 0; i < points.size(); ++i) {
        if (is_inside(points[i]) && is_inside(targets[i])) inside.push_back(i);
        if (!is_inside(points[i]) && !is_inside(targets[i])) rim.push_back(i);
    }
    const std::size_t stride = inside.size() / most_landmark_starts + 1;
    for (std::size_t i = 0; i < inside.size(); i += stride) maps.push_back(about_point(points, targets, inside[i]));
    if (rim.size() >= 2)
        if (const auto map = about_rim(points(rim), targets(rim))) maps.push_back(*map);
    return maps;
}

Moebius nearest_on_disk(const VectorXcd& points, const VectorXcd& targets)
{
    const Moebius center = centering(targets);
    const VectorXcd wanted = center(targets);
    const auto squares = [&](const Moebius& map) { return (map(points) - wanted).squaredNorm(); };
    const VectorXd weights = VectorXd::Ones(points.size());
    Moebius best;
    double least = std::numeric_limits<double>::infinity();
    for (const Moebius& start : starts(points, wanted)) {
        const Moebius map = nearest_automorphism(start(points), wanted, weights) * start;
        for (const Moebius& candidate : {start, map})
            if (const double sum = squares(candidate); sum < least) {
                least = sum;
                best = candidate;
            }
    }
    return center.inverse() * best;
}

}  // namespace

Moebius nearest_symmetry(const std::vector<Circle>& circles, const VectorXcd& points, const VectorXcd& targets)
{
    if (points.size() == 0 || circles.size() > 2) return {};
    if (circles.size() == 1) return nearest_on_disk(points, targets);
    const Moebius center = center_circle(circles[1]);
    const auto directions = [&](const VectorXcd& z) -> VectorXcd {
        return center(z).array() / center(z).array().abs();
    };
    return center.inverse() * nearest_turn(directions(points), directions(targets)) * center;
}

DomainAlignment align_by_landmarks(const std::vector<Circle>& source, const std::vector<Circle>& target,
                                   const VectorXcd& now, const VectorXcd& wanted, const ExecutionContext& context)
{
    constexpr std::size_t most_loops = 6;  // 120 matches
    DomainAlignment best = align_domains(source, target, {}, context);
    if (now.size() == 0 || source.size() < 3 || source.size() > most_loops) return best;
    best.margin = 1.0;  // landmarks decide
    const auto squares = [&](const DomainAlignment& alignment) {
        return (alignment.map(now) - wanted).squaredNorm() / static_cast<double>(now.size()) +
               alignment.residual * alignment.residual;
    };
    double least = squares(best);
    std::vector<int> match = numbers_below<int>(source.size());
    do {
        DomainAlignment next = align_domains(source, target, match, context);
        if (const double sum = squares(next); sum < least) {
            least = sum;
            best = std::move(next);
        }
    } while (std::next_permutation(match.begin() + 1, match.end()));
    return best;
}

AlignedDomain lay_by_landmarks(const Triangles& triangles, const PlanarPoints& uv, const std::vector<Circle>& circles,
                               const VectorXcd& now, const VectorXcd& wanted, Moebius& map)
{
    constexpr int halvings = 10;
    const Moebius plain = map, symmetry = nearest_symmetry(circles, plain(now), wanted);
    const VectorXcd z = uv.col(0) + Complex(0.0, 1.0) * uv.col(1);
    const double length = std::abs(symmetry.a);
    const auto with_share = [&](double share) {
        const double a = std::tanh(share * std::atanh(length));
        map = Moebius{length > 0.0 ? a / length * symmetry.a : Complex(0.0), symmetry.turn} * plain;
        const VectorXcd moved = map(z);
        PlanarPoints points(z.size(), 2);
        points << moved.real(), moved.imag();
        return points;
    };
    const auto folded = [&](const PlanarPoints& points) { return folded_faces(triangles, points).size(); };
    // The largest share of the hyperbolic way that folds no more faces than no way at all.
    const PlanarPoints whole = with_share(1.0);
    if (length == 0.0) return {whole, whole};
    const std::size_t most = folded(with_share(0.0));
    if (folded(whole) <= most) {
        with_share(1.0);
        return {whole, whole};
    }
    double served = 0.0, failed = 1.0;
    for (int i = 0; i < halvings; ++i) {
        const double share = 0.5 * (served + failed);
        (folded(with_share(share)) <= most ? served : failed) = share;
    }
    return {with_share(served), uv};
}

}  // namespace koebe
