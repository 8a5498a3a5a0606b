#include "tiles/even_tile.h"

#include "circles/on_circle.h"
#include "core/tolerances.h"
#include "even/even_map.h"
#include "planar/planar_predicates.h"
#include "surface/importance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

/// The lifts of each face's corners, from its first half-edge on.
CornerLifts lifts_of(const PeriodicSurface& domain)
{
    CornerLifts lifts(static_cast<std::size_t>(domain.surface.triangles.rows()));
    for (std::size_t f = 0; f < lifts.size(); ++f)
        for (int k = 1; k < 3; ++k) {
            const std::array<int, 2> step = domain.shift(static_cast<Index>(3 * f) + k - 1);
            for (int j = 0; j < 2; ++j) lifts[f][k][j] = lifts[f][k - 1][j] + step[j];
        }
    return lifts;
}

double image_area(const PeriodicSurface& domain, const CornerLifts& lifts, const PlanarPoints& points,
                  const std::vector<Complex>& periods)
{
    double sum = 0.0;
    for (Eigen::Index f = 0; f < domain.surface.triangles.rows(); ++f) {
        const CornerPlaces at = corners_of(points, domain.surface.triangles, lifts, periods, f);
        sum += 0.5 * cross(at[1] - at[0], at[2] - at[0]);
    }
    return sum;
}

std::vector<RoundLoop> round_loops(const PeriodicSurface& domain, LoopForm loops, const VectorXcd& z)
{
    std::vector<RoundLoop> round;
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        const bool is_rim = k < domain.first_hole;
        if (!is_rim && loops == LoopForm::free) break;
        RoundLoop& loop = round.emplace_back(RoundLoop{domain.loops[k], {}});
        loop.track.straight = is_rim;
        if (is_rim)
            loop.track.point = z[domain.loops[k].front()];
        else
            loop.track.circle = fit_circle_least_squares(z(domain.loops[k]));
    }
    return round;
}

/// Whether the circles of holes lie between the rims, and apart from each other and their copies.
bool are_apart(std::size_t first_hole, const std::vector<Track>& tracks, const std::vector<Complex>& periods)
{
    std::vector<Circle> circles;
    for (std::size_t k = first_hole; k < tracks.size(); ++k) circles.push_back(tracks[k].circle);
    for (std::size_t rim = 0; rim < first_hole; ++rim)
        for (const Circle& circle : circles)
            if (!(std::abs(circle.center.imag() - tracks[rim].point.imag()) > circle.radius)) return false;
    return apart_in_tile(circles, periods);
}

}  // namespace

bool make_tile_even(const PeriodicSurface& domain, const TileOptions& options, FlatMap& map, ExecutionContext& context)
{
    const CornerLifts lifts = lifts_of(domain);
    PlanarPoints points(map.z.size(), 2);
    points << map.z.real(), map.z.imag();
    const double scale =
        scale_to_size(domain.vertices, domain.surface.triangles, image_area(domain, lifts, points, map.periods));
    if (!std::isfinite(scale) || !(scale > 0.0)) return false;
    points *= scale;
    std::vector<Complex> periods;
    for (const Complex period : map.periods) periods.push_back(scale * period);
    std::vector<RoundLoop> round = round_loops(domain, options.loops, scale * map.z);
    const std::vector<VertexLoop> holes(domain.loops.begin() + static_cast<std::ptrdiff_t>(domain.first_hole),
                                        domain.loops.end());
    const double extent = points.maxCoeff() - points.minCoeff();
    FlatSurface flat{domain.vertices, domain.surface.triangles, holes, points, round, lifts, &periods};
    flat.refuses = [&](const FoldoverPlaces& places) {
        return !are_apart(domain.first_hole, places.tracks, places.periods);
    };
    if (!options.importance.empty()) {
        VectorXd importance(domain.vertices.rows());
        for (Eigen::Index v = 0; v < importance.size(); ++v) importance[v] = options.importance[domain.original[v]];
        flat.sizes = size_factors(domain.vertices, domain.surface.triangles, importance);
    }
    if (!make_even(flat, options.even, extent, context).moved) return false;
    std::vector<Track> tracks;
    for (const RoundLoop& loop : round) tracks.push_back(loop.track);
    if (!are_apart(domain.first_hole, tracks, periods)) return false;
    map.z = (points.col(0) + Complex(0.0, 1.0) * points.col(1)) / scale;
    for (std::size_t j = 0; j < periods.size(); ++j) map.periods[j] = periods[j] / scale;
    const Complex lower = domain.first_hole > 0 ? Complex(0.0, round.front().track.point.imag() / scale) : 0.0;
    map.z.array() -= lower;
    map.circles.clear();
    map.off_circle.clear();
    map.apart = true;
    for (std::size_t k = 0; k < domain.first_hole; ++k)
        for (const Index v : domain.loops[k])
            if (std::abs(points(v, 1) - round[k].track.point.imag()) > uv_resolution * scale)
                map.off_circle.push_back(v);
    for (std::size_t k = domain.first_hole; k < round.size(); ++k) {
        const Circle circle{round[k].track.circle.center / scale - lower, round[k].track.circle.radius / scale};
        map.circles.push_back(circle);
        for (const Index v : domain.loops[k])
            if (!is_on_circle(circle, map.z[v], inner_circle_tolerance)) map.off_circle.push_back(v);
    }
    std::ranges::sort(map.off_circle);
    return true;
}

}  // namespace koebe
