#include "pipeline/even_disk.h"

#include "circles/crowded_circles.h"
#include "core/complex_places.h"
#include "core/errors.h"
#include "even/even_map.h"
#include "pipeline/final_check.h"
#include "pipeline/flip_removal.h"
#include "pipeline/normalization.h"
#include "planar/boundary_crossings.h"
#include "surface/importance.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double shortest_drawn = 1e-7;  // disk units: a smaller loop is too small to tell which way it turns

std::vector<RoundLoop> round_loops(const MapInput& whole, const CircleMap& map, double scale)
{
    std::vector<RoundLoop> round;
    for (std::size_t k = 0; k < whole.loops.size(); ++k) {
        RoundLoop& loop = round.emplace_back();
        std::ranges::copy_if(whole.loops[k], std::back_inserter(loop.vertices),
                             [&](Index v) { return !std::ranges::binary_search(map.off_circle, v); });
        loop.track.circle = {scale * map.circles[k].center, scale * map.circles[k].radius};
    }
    return round;
}

/// Whether the circles that loops ride on would be those of a circle domain, if the outer one is one of them.
bool are_apart(const std::vector<RoundLoop>& round, const std::vector<Track>& tracks)
{
    if (round.empty() || round.front().vertices.empty()) return true;
    const Circle& outer = tracks.front().circle;
    std::vector<Circle> circles{Circle{}};
    for (std::size_t k = 1; k < round.size(); ++k)
        if (!round[k].vertices.empty())
            circles.push_back(
                {(tracks[k].circle.center - outer.center) / outer.radius, tracks[k].circle.radius / outer.radius});
    return circles_apart(circles);
}

VectorXcd image_of(const VertexLoop& loop, const PlanarPoints& points)
{
    VectorXcd image(static_cast<Eigen::Index>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i) image[static_cast<Eigen::Index>(i)] = complex_at(points, loop[i]);
    return image;
}

/// The circle round all points, about the middle of their bounding box.
Circle circle_round(const PlanarPoints& points)
{
    const Eigen::RowVector2d middle = 0.5 * (points.colwise().minCoeff() + points.colwise().maxCoeff());
    return {{middle[0], middle[1]}, (points.rowwise() - middle).rowwise().norm().maxCoeff()};
}

/// Moves and scales points so that the outer circle becomes the unit circle.
void bring_home(const Circle& outer, PlanarPoints& points)
{
    points.rowwise() -= Eigen::RowVector2d(outer.center.real(), outer.center.imag());
    points /= outer.radius;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        if (const double length = points.row(v).norm(); length > 1.0) points.row(v) /= length;
}

}  // namespace

void require_even_disk(double even, Index center)
{
    require_even(even);
    if (even > 0.0 && center >= 0)
        throw InputError("even and center exclude each other: a more even map keeps no vertex at the centre",
                         ElementKind::vertices, {center});
}

bool make_disk_even(const MapInput& whole, double even, LoopForm loops, CircleMap& map, ExecutionContext& context)
{
    const Triangles& triangles = whole.surface.triangles;
    double image = std::abs(enclosed_area(whole.loops[0], map.uv));
    for (std::size_t k = 1; k < whole.loops.size(); ++k) image -= std::abs(enclosed_area(whole.loops[k], map.uv));
    const double scale = scale_to_size(whole.vertices, triangles, image);
    if (!std::isfinite(scale) || !(scale > 0.0)) return false;
    CircleMap relaxed = map;
    relaxed.uv *= scale;
    std::vector<RoundLoop> round;
    if (loops != LoopForm::free) round = round_loops(whole, map, scale);
    FlatSurface flat{whole.vertices, triangles, whole.loops, relaxed.uv, round};
    flat.sizes = size_factors(whole.vertices, triangles, whole.importance);
    flat.refuses = [&round](const FoldoverPlaces& places) { return !are_apart(round, places.tracks); };
    if (!make_even(flat, even, 2.0 * scale, context).moved) return false;
    const bool rides = !round.empty() && !round.front().vertices.empty();
    const Circle outer = rides ? round.front().track.circle : circle_round(relaxed.uv);
    bring_home(outer, relaxed.uv);
    for (std::size_t k = 0; k < whole.loops.size(); ++k) {
        Circle& circle = relaxed.circles[k];
        if (round.empty() || round[k].vertices.empty()) {
            circle = k == 0 ? Circle{} : fit_circle_least_squares(image_of(whole.loops[k], relaxed.uv));
            continue;
        }
        circle = round[k].track.circle;
        circle =
            k == 0 ? Circle{} : Circle{(circle.center - outer.center) / outer.radius, circle.radius / outer.radius};
        for (const Index v : round[k].vertices) {
            const Complex place = Track{.circle = circle}.nearest(complex_at(relaxed.uv, v));
            relaxed.uv.row(v) << place.real(), place.imag();
        }
    }
    normalize(whole, relaxed);
    if (loops != LoopForm::free) remove_flips(whole, relaxed, context);
    MapFaults faults = find_faults(triangles, whole.loops, relaxed.uv, relaxed.circles);
    if (loops == LoopForm::free) faults.bad_circles.clear();  // these are no circles of the map
    if (faults.any() || !turned_loops(whole.loops, relaxed.uv, shortest_drawn).empty()) return false;
    map = std::move(relaxed);
    return true;
}

}  // namespace koebe
