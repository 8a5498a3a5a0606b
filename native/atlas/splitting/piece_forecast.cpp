#include "splitting/piece_forecast.h"

#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "core/connectivity.h"
#include "cost/tuning.h"
#include "part_maps/even_pole.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr std::size_t pole_samples = 150, most_samples = 2000;  // faces

struct PieceLoop {
    Index piece;
    Circle circle;
    double width, deviation;
};

double width_of(const VectorXcd& points)
{
    return std::max(points.real().maxCoeff() - points.real().minCoeff(),
                    points.imag().maxCoeff() - points.imag().minCoeff());
}

/// The boundary loops of all pieces, traced along their edges.
std::vector<PieceLoop> piece_loops(const PartMesh& part, const PartMap& map, const std::vector<Index>& piece)
{
    const Surface& surface = part.surface;
    const Triangles& triangles = surface.triangles;
    const auto inside = [&](Index h) {
        const Index t = surface.twin[h];
        return t != no_twin && piece[face_of(t)] == piece[face_of(h)];
    };
    std::vector<char> seen(triangles.size(), 0);
    std::vector<PieceLoop> loops;
    std::vector<Complex> points;
    // From each edge on the border of a piece, once round.
    for (Index first = 0; first < static_cast<Index>(triangles.size()); ++first) {
        if (seen[first] || piece[face_of(first)] < 0 || inside(first)) continue;
        points.clear();
        for (Index h = first; !seen[h];) {
            seen[h] = 1;
            points.push_back(map.positions[origin(triangles, h)]);
            // The next border edge around the end vertex.
            h = next_halfedge(h);
            while (inside(h)) h = next_halfedge(surface.twin[h]);
        }
        const VectorXcd at = Eigen::Map<const VectorXcd>(points.data(), static_cast<Eigen::Index>(points.size()));
        const Circle circle = fit_circle_least_squares(at);
        loops.push_back({piece[face_of(first)], circle, width_of(at), deviation_from(circle, at)});
    }
    return loops;
}

MapSample every(const MapSample& sample, std::size_t most)
{
    const Eigen::Index count = sample.u.size();
    const Eigen::Index stride = std::max<Eigen::Index>(1, count / static_cast<Eigen::Index>(most));
    if (stride == 1) return sample;
    std::vector<Eigen::Index> picked;
    for (Eigen::Index i = 0; i < count; i += stride) picked.push_back(i);
    return {sample.centers(picked), sample.u(picked), sample.areas(picked)};
}

/// Of the sample unrolled about a loop's circle.
double tube_overflow(const MapSample& sample, const Circle& circle)
{
    const Complex about = center_circle(circle).a;
    constexpr double tiny = std::numeric_limits<double>::min();
    const VectorXd u = sample.u.array() + std::log(1.0 - std::norm(about)) -
                       0.5 * (sample.centers.array() - about).abs2().max(tiny).log() -
                       0.5 * (1.0 - std::conj(about) * sample.centers.array()).abs2().max(tiny).log();
    return u.allFinite() ? rough_overflow(u, sample.areas) : tuning::lost_cost * sample.areas.sum();
}

/// @param loops loops of the piece, the outer loop first
void judge(MapSample sample, const std::vector<PieceLoop>& loops, PieceForecast& forecast)
{
    const double known = forecast.area - forecast.lost_area;
    forecast.overflow = tuning::lost_cost * forecast.lost_area;
    if (sample.u.size() == 0 || !(known > 0.0)) return;
    Circle outer = loops.front().circle;
    if (!(outer.radius > 0.0)) outer = {};
    sample.centers = ((sample.centers.array() - outer.center) / outer.radius).eval();
    sample.u.array() -= std::log(outer.radius);
    std::vector<Circle> circles;
    for (const PieceLoop& loop : loops) {
        circles.push_back({(loop.circle.center - outer.center) / outer.radius, loop.circle.radius / outer.radius});
        forecast.off_round = std::max(forecast.off_round, loop.deviation);
    }
    circles.front() = {};
    const EvenPole pole = even_pole(every(sample, pole_samples), circles, 0);
    const MapSample disk = moved(sample, circles, pole);
    double overflow = disk.u.allFinite() ? rough_overflow(disk.u, disk.areas) : tuning::lost_cost * disk.areas.sum();
    if (circles.size() == 2) overflow = std::min(overflow, tube_overflow(sample, circles[1]));
    forecast.overflow += overflow * known / sample.areas.sum();
}

}  // namespace

std::vector<PieceForecast> forecast_pieces(const PartMesh& part, const PartMap& map, const std::vector<Index>& piece,
                                           Index count)
{
    std::vector<PieceForecast> forecasts(count);
    // Areas, and the faces that the map has not lost.
    std::vector<std::vector<Index>> faces(count);
    for (std::size_t f = 0; f < piece.size(); ++f) {
        if (piece[f] < 0) continue;
        const double area = part.areas[static_cast<Eigen::Index>(f)];
        forecasts[piece[f]].area += area;
        if (map.lost[f])
            forecasts[piece[f]].lost_area += area;
        else
            faces[piece[f]].push_back(static_cast<Index>(f));
    }
    // Loops, the widest first: it is the outer one.
    std::vector<std::vector<PieceLoop>> loops(count);
    for (const PieceLoop& loop : piece_loops(part, map, piece)) loops[loop.piece].push_back(loop);
    for (Index k = 0; k < count; ++k) {
        if (loops[k].empty()) continue;
        std::ranges::iter_swap(loops[k].begin(), std::ranges::max_element(loops[k], {}, &PieceLoop::width));
        // Judge by a sample of the faces.
        std::vector<Index> picked;
        const std::size_t stride = std::max<std::size_t>(1, faces[k].size() / most_samples);
        for (std::size_t i = 0; i < faces[k].size(); i += stride) picked.push_back(faces[k][i]);
        judge({map.centers(picked), map.u(picked), part.areas(picked)}, loops[k], forecasts[k]);
    }
    return forecasts;
}

}  // namespace koebe
