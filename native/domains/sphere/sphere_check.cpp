#include "sphere/sphere_check.h"

#include "core/numbering.h"
#include "execution/each_in_pieces.h"
#include "planar/boundary_crossings.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace koebe {
namespace {

constexpr double area_rounding = 1e-6;  // on the sum of all areas, which is a multiple of 4 pi

/// Area of a loop's hole by triangles round a point; nothing unless all are upright.
std::optional<double> star_area(const VertexLoop& loop, const Vertices& points, const SpherePoint& middle)
{
    double area = 0.0;
    for (std::size_t b = 0; b < loop.size(); ++b) {  // the loop runs clockwise round its hole
        const SpherePoint from = points.row(loop[b]), to = points.row(loop[(b + 1) % loop.size()]);
        if (orientation(middle, to, from) <= 0) return std::nullopt;
        area += solid_angle(middle, to, from);
    }
    return area;
}

/// Area of a loop's hole in one half of the sphere, which central projection shows with straight edges; nothing unless
/// the loop is simple there. @param axis the middle of that half
std::optional<double> projected_area(const VertexLoop& loop, const Vertices& points, const SpherePoint& axis)
{
    const SpherePoint x = axis.unitOrthogonal(), y = axis.cross(x);
    PlanarPoints plane(static_cast<Eigen::Index>(loop.size()), 2);
    for (std::size_t b = 0; b < loop.size(); ++b) {
        const SpherePoint p = points.row(loop[b]);
        const double depth = p.dot(axis);
        if (!(depth > 1e-3)) return std::nullopt;
        plane.row(static_cast<Eigen::Index>(b)) << p.dot(x) / depth, p.dot(y) / depth;
    }
    VertexLoop order = numbers_below(loop.size());
    if (loops_cross({order}, plane, 0.0)) return std::nullopt;
    double area = 0.0;
    for (std::size_t b = 0; b < loop.size(); ++b)
        area += solid_angle(axis, points.row(loop[(b + 1) % loop.size()]), points.row(loop[b]));
    return area < 0.0 ? area + 4.0 * std::numbers::pi : area;  // it runs round the rest of the sphere
}

std::optional<double> hole_area(const VertexLoop& loop, const Vertices& points, const Cap& cap)
{
    SpherePoint mean = SpherePoint::Zero();
    for (const Index v : loop) mean += points.row(v).transpose();
    std::vector<SpherePoint> middles{cap.center};
    if (mean.norm() > 0.0) {
        middles.push_back(mean.normalized());
        middles.push_back(-mean.normalized());
    }
    // The hole of a loop that runs the other way is the rest of the sphere.
    const auto fits = [&](double area) {
        return std::abs(area - 2.0 * std::numbers::pi * (1.0 - std::cos(cap.radius))) < 2.0 * std::numbers::pi;
    };
    for (const SpherePoint& middle : middles)
        if (const auto area = star_area(loop, points, middle); area && fits(*area)) return area;
    for (const SpherePoint& axis : {SpherePoint(-middles.back()), SpherePoint(-cap.center), cap.center})
        if (const auto area = projected_area(loop, points, axis); area && fits(*area)) return area;
    return std::nullopt;
}

}  // namespace

bool upright_on_sphere(const Triangles& triangles, const Vertices& points, Index face)
{
    return orientation(points.row(triangles(face, 0)), points.row(triangles(face, 1)), points.row(triangles(face, 2))) >
           0;
}

double longest_edge_on_sphere(const Triangles& triangles, const Vertices& points, Index face)
{
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (points.row(triangles(face, (k + 1) % 3)) - points.row(triangles(face, k))).norm());
    return longest;
}

SphereFaults find_sphere_faults(const Triangles& triangles, const std::vector<VertexLoop>& loops,
                                const Vertices& points, const std::vector<Cap>& caps)
{
    SphereFaults faults;
    const auto face_count = static_cast<Index>(triangles.rows());
    // The solid angle of each face, and faces that are turned over. Some of these are too small for 32 bits.
    VectorXd areas(face_count);
    each_in_pieces(face_count, [&](Index f) {
        areas[f] = solid_angle(points.row(triangles(f, 0)), points.row(triangles(f, 1)), points.row(triangles(f, 2)));
    });
    double covered = areas.sum();
    faults.flipped = found_in_pieces(face_count, [&](Index f) { return !upright_on_sphere(triangles, points, f); });
    for (const Index f : faults.flipped)
        if (longest_edge_on_sphere(triangles, points, f) < sphere_resolution) faults.below_resolution.push_back(f);
    // The solid angle of each hole; a rim without a hole's shape is at fault.
    for (std::size_t k = 0; k < loops.size(); ++k) {
        double extent = 0.0;
        for (const Index v : loops[k]) extent = std::max(extent, (points.row(v) - points.row(loops[k][0])).norm());
        if (extent < sphere_resolution) {
            faults.lost_holes.push_back(static_cast<int>(k));
        } else if (const auto area = hole_area(loops[k], points, caps[k])) {
            covered += *area;
        } else {
            faults.holes.push_back(static_cast<int>(k));
        }
    }
    // Faces and holes cover the sphere once: their solid angles add up to 4 pi.
    const double sheets = covered / (4.0 * std::numbers::pi);
    faults.covering = faults.holes.empty() && !(std::abs(sheets - 1.0) < area_rounding);
    return faults;
}

}  // namespace koebe
