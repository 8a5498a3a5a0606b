#include "flatten/allowance.h"

#include "flatten/edge_distance.h"
#include "planar/boundary_crossings.h"

// These enumerations of Boost get a fixed underlying type: Boost counts beyond their last value, which Clang refuses
// otherwise.
// clang-format off
#define int_float_mixture_enum int_float_mixture_enum : int
#define sign_mixture_enum sign_mixture_enum : int
#define udt_builtin_mixture_enum udt_builtin_mixture_enum : int
// clang-format on
#include <boost/numeric/conversion/int_float_mixture_enum.hpp>
#include <boost/numeric/conversion/sign_mixture_enum.hpp>
#include <boost/numeric/conversion/udt_builtin_mixture_enum.hpp>
#undef int_float_mixture_enum
#undef sign_mixture_enum
#undef udt_builtin_mixture_enum

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false>;  // counter-clockwise
using Polygons = bg::model::multi_polygon<Polygon>;

constexpr double chord = 0.02;              // from an arc at most
constexpr int tries = 8;                    // with other corners, from the second on without small ones:
constexpr double simpler = 5e-4;            // of the width, by which the outline may be off then, times the try
constexpr double nearest = 0.985;           // of the width: rings that come nearer are refused,
constexpr double farthest = 1.005;          // or reach farther
constexpr double shortest_edge = 1e-9;      // of the width
constexpr std::size_t fewest_corners = 16;  // of a circle

std::vector<VertexLoop> outer_first(std::vector<VertexLoop> loops, const PlanarPoints& points)
{
    std::ranges::stable_sort(loops, std::ranges::greater(),
                             [&](const VertexLoop& loop) { return std::abs(enclosed_area(loop, points)); });
    return loops;
}

Polygon polygon_of(const std::vector<VertexLoop>& loops, const PlanarPoints& points)
{
    Polygon polygon;
    polygon.inners().resize(loops.size() - 1);
    for (std::size_t k = 0; k < loops.size(); ++k) {
        auto& ring = k == 0 ? polygon.outer() : polygon.inners()[k - 1];
        for (const Index v : loops[k]) ring.emplace_back(points(v, 0), points(v, 1));
        ring.push_back(ring.front());
    }
    bg::correct(polygon);
    return polygon;
}

template <class Ring>
PlanarPoints points_of(const Ring& ring)
{
    PlanarPoints points(static_cast<Eigen::Index>(ring.size()) - 1, 2);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const auto& point = ring[static_cast<std::size_t>(i)];
        points.row(i) << point.x(), point.y();
    }
    return points;
}

/// How often loops of points run round a point.
int winding(const PlanarPoints& ring, const Eigen::RowVector2d& p)
{
    int turns = 0;
    for (Eigen::Index i = 0; i < ring.rows(); ++i) {
        const Eigen::RowVector2d a = ring.row(i) - p, b = ring.row((i + 1) % ring.rows()) - p;
        const double side = a[0] * b[1] - a[1] * b[0];
        if (a[1] <= 0.0 && b[1] > 0.0 && side > 0.0) ++turns;
        if (a[1] > 0.0 && b[1] <= 0.0 && side < 0.0) --turns;
    }
    return turns;
}

/// Whether rings keep their distance from the outline, cross nothing, and run round it once.
bool fit(const std::vector<PlanarPoints>& rings, const std::vector<VertexLoop>& loops, const PlanarPoints& points,
         double width)
{
    if (rings.empty()) return false;
    // Their distance from the outline is the allowance's width, within bounds.
    for (const PlanarPoints& ring : rings)
        for (const auto& p : ring.rowwise()) {
            double least = std::numeric_limits<double>::infinity();
            for (const VertexLoop& loop : loops)
                for (std::size_t i = 0; i < loop.size(); ++i)
                    least = std::min(least,
                                     distance_to_edge(p, points.row(loop[i]), points.row(loop[(i + 1) % loop.size()])));
            if (!(least >= nearest * width && least <= farthest * width)) return false;
        }
    // Together with the outline nothing crosses.
    std::vector<VertexLoop> all = loops;
    PlanarPoints together = points;
    for (const PlanarPoints& ring : rings) {
        VertexLoop& own = all.emplace_back();
        for (Eigen::Index i = 0; i < ring.rows(); ++i) own.push_back(static_cast<Index>(together.rows() + i));
        together.conservativeResize(together.rows() + ring.rows(), 2);
        together.bottomRows(ring.rows()) = ring;
    }
    if (loops_cross(all, together, shortest_edge * width)) return false;
    // They wind once round each loop.
    return std::ranges::all_of(loops, [&](const VertexLoop& loop) {
        int turns = 0;
        for (const PlanarPoints& ring : rings) turns += winding(ring, points.row(loop.front()));
        return turns == 1;
    });
}

}  // namespace

std::vector<PlanarPoints> allowance_rings(const std::vector<VertexLoop>& loops, const PlanarPoints& points,
                                          double width)
{
    const std::vector<VertexLoop> sorted = outer_first(loops, points);
    const Polygon polygon = polygon_of(sorted, points);
    const double step = std::acos(std::max(1.0 - chord / width, 0.0));
    const auto corners = std::max(fewest_corners, static_cast<std::size_t>(std::numbers::pi / step) + 1);
    const bg::strategy::buffer::distance_symmetric<double> distance(width);
    const bg::strategy::buffer::side_straight side;
    const bg::strategy::buffer::end_round end(corners);
    const bg::strategy::buffer::point_circle circle(corners);
    // The buffer fails for some outlines: simpler outlines and other corners follow.
    for (std::size_t k = 0; k < tries; ++k) {
        const bg::strategy::buffer::join_round join(corners + 3 * k);
        Polygons grown;
        try {
            Polygon outline = polygon;
            if (k > 0) bg::simplify(polygon, outline, simpler * static_cast<double>(k) * width);
            bg::buffer(outline, grown, distance, side, join, end, circle);
        } catch (const bg::exception&) {
            continue;
        }
        std::vector<PlanarPoints> rings;
        for (const Polygon& one : grown) {
            rings.push_back(points_of(one.outer()));
            for (const auto& inner : one.inners()) rings.push_back(points_of(inner));
        }
        if (fit(rings, sorted, points, width)) return rings;
    }
    return {};
}

}  // namespace koebe
