#include "canonical/canonical_position.h"

#include "core/all_elements.h"
#include "core/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double coarsest = 0x1p-34;  // grid step over the extent
constexpr double finest = 0x1p-50;
constexpr double of_shortest = 0x1p-22;  // grid step over the shortest edge

[[noreturn]] void throw_one_point(Eigen::Index vertex_count)
{
    throw InputError("all vertices lie on one point", ElementKind::vertices, all_elements(vertex_count));
}

/// One value for each block of rows.
template <class Value>
std::vector<Value> of_pieces(Eigen::Index rows,
                             const std::function<Value(Eigen::Index first, Eigen::Index count)>& value)
{
    std::vector<Value> values((static_cast<std::size_t>(rows) + rows_at_a_time - 1) / rows_at_a_time);
    each_rows(rows, [&](Eigen::Index first, Eigen::Index count) {
        values[static_cast<std::size_t>(first) / rows_at_a_time] = value(first, count);
    });
    return values;
}

/// The row that is farthest by a measure, the first of about equal ones. A block whose largest value is no better is
/// skipped.
template <class Measure>
Eigen::Index farthest(Eigen::Index rows, const Measure& measure)
{
    const std::vector<double> largest = of_pieces<double>(rows, [&](Eigen::Index first, Eigen::Index count) {
        double result = 0.0;
        for (Eigen::Index v = first; v < first + count; ++v) result = std::max(result, measure(v));
        return result;
    });
    Eigen::Index best = 0;
    double most = measure(0);
    for (std::size_t piece = 0; piece < largest.size(); ++piece) {
        const Eigen::Index first = static_cast<Eigen::Index>(piece * rows_at_a_time);
        const Eigen::Index end = std::min(rows, first + static_cast<Eigen::Index>(rows_at_a_time));
        if (largest[piece] > (1.0 + same_size) * most)
            for (Eigen::Index v = first; v < end; ++v)
                if (const double m = measure(v); m > (1.0 + same_size) * most) {
                    most = m;
                    best = v;
                }
    }
    return best;
}

/// The shortest edge and the least height of some faces; infinite without faces.
std::pair<double, double> least_sizes(const Triangles& triangles, const Vertices& points, Eigen::Index begin,
                                      Eigen::Index end)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    double shortest = none, thinnest = none;
    for (Eigen::Index f = begin; f < end; ++f) {
        const auto edge = [&](int k) -> Eigen::RowVector3d {
            return points.row(triangles(f, (k + 1) % 3)) - points.row(triangles(f, k));
        };
        const Eigen::RowVector3d first = edge(0), last = edge(2);
        double longest = 0.0;
        for (const double length : {first.norm(), edge(1).norm(), last.norm()}) {
            if (length > 0.0) shortest = std::min(shortest, length);
            longest = std::max(longest, length);
        }
        thinnest = std::min(thinnest, longest > 0.0 ? first.cross(last).norm() / longest : 0.0);
    }
    return {shortest, thinnest};
}

/// @return the least height of a face, in steps of the grid
double put_on_grid(const Triangles& triangles, Vertices& points)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    const auto least =
        of_pieces<std::pair<double, double>>(triangles.rows(), [&](Eigen::Index begin, Eigen::Index count) {
            return least_sizes(triangles, points, begin, begin + count);
        });
    double shortest = none, thinnest = none;
    for (const auto& [edge, height] : least) {
        shortest = std::min(shortest, edge);
        thinnest = std::min(thinnest, height);
    }
    const double grid = std::exp2(std::round(std::log2(std::clamp(of_shortest * shortest, finest, coarsest))));
    thinnest /= grid;
    each_rows(points.rows(), [&](Eigen::Index begin, Eigen::Index count) {
        auto piece = points.middleRows(begin, count).array();
        piece = (piece / grid).round() * grid;
    });
    return thinnest;
}

}  // namespace

Vertices scaled_position(const Surface& surface, const Vertices& vertices)
{
    using Point = Eigen::RowVector3d;
    // The box of the vertices that faces use, in pieces side by side.
    Point low = vertices.row(surface.triangles(0, 0)), high = low;
    const auto boxes =
        of_pieces<std::pair<Point, Point>>(surface.triangles.rows(), [&](Eigen::Index first, Eigen::Index count) {
            Point least = vertices.row(surface.triangles(first, 0)), most = least;
            for (Eigen::Index i = 3 * first; i < 3 * (first + count); ++i) {
                least = least.cwiseMin(vertices.row(surface.triangles.data()[i]));
                most = most.cwiseMax(vertices.row(surface.triangles.data()[i]));
            }
            return std::pair(least, most);
        });
    for (const auto& [least, most] : boxes) {
        low = low.cwiseMin(least);
        high = high.cwiseMax(most);
    }
    // Halves are added, as a sum of large numbers could overflow.
    const Point middle = 0.5 * low + 0.5 * high;
    const double extent = (0.5 * high - 0.5 * low).maxCoeff();
    if (!(extent > 0.0)) throw_one_point(vertices.rows());
    Vertices result(vertices.rows(), 3);
    each_rows(vertices.rows(), [&](Eigen::Index first, Eigen::Index count) {
        result.middleRows(first, count) = (vertices.middleRows(first, count).rowwise() - middle) / extent;
    });
    return result;
}

CanonicalPosition turned_position(const Triangles& triangles, Vertices points)
{
    const Eigen::RowVector3d mean = points.colwise().mean();
    const std::vector<double> extents = of_pieces<double>(points.rows(), [&](Eigen::Index first, Eigen::Index count) {
        auto piece = points.middleRows(first, count);
        piece.rowwise() -= mean;
        return piece.rowwise().norm().maxCoeff();
    });
    const Eigen::Vector3d reach =
        points.row(farthest(points.rows(), [&](Eigen::Index v) { return points.row(v).norm(); }));
    const double extent = *std::max_element(extents.begin(), extents.end());
    if (!(extent > 0.0)) throw_one_point(points.rows());
    const Eigen::Vector3d first = reach / reach.norm();
    const auto aside = [&](Eigen::Index v) -> Eigen::Vector3d {
        const Eigen::Vector3d p = points.row(v);
        return p - p.dot(first) * first;
    };
    const Eigen::Vector3d sideways = aside(farthest(points.rows(), [&](Eigen::Index v) { return aside(v).norm(); }));
    // All vertices on a line: any second axis will do.
    const Eigen::Vector3d second =
        sideways.norm() > same_size * extent ? Eigen::Vector3d(sideways / sideways.norm()) : first.unitOrthogonal();
    Eigen::Matrix3d frame;
    frame << first, second, first.cross(second);
    each_rows(points.rows(), [&](Eigen::Index begin, Eigen::Index count) {
        auto piece = points.middleRows(begin, count);
        piece = (piece * frame / extent).eval();
    });
    const double thinnest = put_on_grid(triangles, points);
    return {std::move(points), thinnest, frame};
}

CanonicalPosition canonical_position(const Surface& surface, const Vertices& vertices)
{
    return turned_position(surface.triangles, scaled_position(surface, vertices));
}

}  // namespace koebe
