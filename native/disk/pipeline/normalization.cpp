#include "pipeline/normalization.h"

#include "circles/moebius.h"
#include "core/complex_places.h"
#include "pipeline/flip_removal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr int most_centering_rounds = 12;
constexpr double settled = 1e-10;   // disk units: the remaining distance is moved vertex by vertex
constexpr double worthwhile = 0.5;  // share of the distance from 0 that a round may leave
constexpr double on_circle = 1e-9;  // disk units: off the unit circle by rounding alone

/// The image of a circle inside the disk. Its radius is not computed as a difference of points: for a tiny circle that
/// would lose too many digits.
Circle image_of(const Circle& circle, const Moebius& moebius)
{
    const double a = std::abs(moebius.a), pole = std::abs(1.0 - std::conj(moebius.a) * circle.center);
    const double radius = circle.radius * (1.0 - a * a) / (pole * pole - a * a * circle.radius * circle.radius);
    return {moebius(circle).center, radius};
}

/// The centre's place in a map of the solver's surface. If it lies in an ear, the ear is drawn first.
Complex center_of(const MapInput& whole, const EarCut& cut, const CircleMap& map, ExecutionContext& context)
{
    if (cut.ears.empty()) return complex_at(map.uv, whole.center);
    const auto kept = std::ranges::find(cut.vertices, whole.center);
    if (kept != cut.vertices.end()) return complex_at(map.uv, static_cast<Index>(kept - cut.vertices.begin()));
    return complex_at(with_ears(whole, cut, map, context).uv, whole.center);
}

}  // namespace

CircleMap with_center_moved(const MapSolver& solver, const MapInput& whole, const EarCut& cut, const CircleMap& map,
                            ExecutionContext& context)
{
    CircleMap best = map;
    Complex center = center_of(whole, cut, map, context);
    Moebius total;
    for (int round = 0; round < most_centering_rounds && std::abs(center) > settled; ++round) {
        context.checkpoint();
        // One automorphism without a turn, applied to the first map, so that rounding does not add up.
        const Moebius next{total.inverse()(center)};
        if (!(std::abs(next.a) < 1.0)) break;
        std::optional<CircleMap> moved = moved_by(solver, map, next);
        if (!moved) break;
        const Complex now = center_of(whole, cut, *moved, context);
        if (!(std::abs(now) < std::abs(center))) break;
        const bool last = std::abs(now) > worthwhile * std::abs(center);
        best = std::move(*moved);
        total = next;
        center = now;
        if (last) break;
    }
    return best;
}

void move_points(const MapInput& whole, const Moebius& moebius, CircleMap& map)
{
    for (std::size_t k = 1; k < map.circles.size(); ++k) map.circles[k] = image_of(map.circles[k], moebius);
    const VectorXcd before = map.uv.col(0) + Complex(0.0, 1.0) * map.uv.col(1);
    VectorXcd points = moebius(before);
    for (const Index v : whole.loops[0])
        if (std::abs(std::abs(before[v]) - 1.0) < on_circle) points[v] /= std::abs(points[v]);
    map.uv << points.real(), points.imag();
}

void normalize(const MapInput& whole, CircleMap& map)
{
    if (held_vertices(whole).empty()) return;
    Moebius moebius;
    if (whole.center >= 0) moebius.a = complex_at(map.uv, whole.center);
    if (!(std::abs(moebius.a) < 1.0)) return;
    if (whole.point >= 0) {
        const Complex image = moebius(complex_at(map.uv, whole.point));
        moebius.turn = std::conj(image) / std::abs(image);
    }
    if (moebius.a == 0.0 && moebius.turn == 1.0) return;
    move_points(whole, moebius, map);
    if (whole.center >= 0) map.uv.row(whole.center).setZero();
    if (whole.point >= 0) map.uv.row(whole.point) << 1.0, 0.0;
}

std::vector<Index> held_vertices(const MapInput& whole)
{
    std::vector<Index> held;
    for (const Index v : {whole.center, whole.point})
        if (v >= 0) held.push_back(v);
    return held;
}

}  // namespace koebe
