#include "quality/distortion.h"

#include "core/length.h"
#include "quality/stored_uv.h"
#include "surface/laplacian.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double thin = 1e-10;  // twice the area over the squared longest edge, dimensionless
constexpr double log_area_floor = 1e-300;

/// A triangle of the surface laid into the plane: corners 0, p1 = (length, 0), p2.
struct FlatTriangle {
    double p1x, p2x, p2y;
};

FlatTriangle lay_flat(const Vertices& vertices, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector3d e1 = vertices.row(triangles(f, 1)) - vertices.row(triangles(f, 0));
    const Eigen::RowVector3d e2 = vertices.row(triangles(f, 2)) - vertices.row(triangles(f, 0));
    const double length = length_of(e1);
    if (!(length > 0.0)) return {0.0, 0.0, 0.0};
    const Eigen::RowVector3d direction = e1 / length;
    return {length, direction.dot(e2), length_of(direction.cross(e2))};
}

/// The angle from the corner (a, b) to the corner (c, d), both counted as positive and below pi.
double angle_change(double ax, double ay, double bx, double by, double cx, double cy, double dx, double dy)
{
    const double cos1 = ax * bx + ay * by, sin1 = std::abs(ax * by - ay * bx);
    const double cos2 = cx * dx + cy * dy, sin2 = std::abs(cx * dy - cy * dx);
    return std::atan2(sin2 * cos1 - cos2 * sin1, cos1 * cos2 + sin1 * sin2);
}

}  // namespace

std::vector<Index> flipped_faces(const Triangles& triangles, const PlanarPoints& uv)
{
    std::vector<Index> flipped;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (StoredFace(triangles, uv, f).flipped()) flipped.push_back(static_cast<Index>(f));
    return flipped;
}

Distortion measure_distortion(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv)
{
    Distortion result;
    result.flipped = flipped_faces(triangles, uv);
    for (const Index f : result.flipped)
        if (StoredFace(triangles, uv, f).below_resolution()) result.below_resolution.push_back(f);

    double angle_sum = 0.0, angle_squares = 0.0, corners = 0.0;
    double mu_sum = 0.0, surface_area = 0.0, log_sum = 0.0, log_squares = 0.0;
    double dirichlet = 0.0, image_area = 0.0;
    double log_min = std::numeric_limits<double>::infinity(), log_max = -log_min;
    double log_origin = 0.0;  // the first ratio: the variance is taken about it, free of cancellation
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const FlatTriangle flat = lay_flat(vertices, triangles, f);
        const double ax = uv(triangles(f, 1), 0) - uv(triangles(f, 0), 0);
        const double ay = uv(triangles(f, 1), 1) - uv(triangles(f, 0), 1);
        const double bx = uv(triangles(f, 2), 0) - uv(triangles(f, 0), 0);
        const double by = uv(triangles(f, 2), 1) - uv(triangles(f, 0), 1);
        const double uv_area = 0.5 * (ax * by - ay * bx);
        image_area += uv_area;
        const double area = 0.5 * flat.p1x * flat.p2y;
        const double height_squared = flat.p2y * flat.p2y, rest = flat.p2x - flat.p1x;
        const double longest_squared =
            std::max({flat.p1x * flat.p1x, flat.p2x * flat.p2x + height_squared, rest * rest + height_squared});
        if (!(2.0 * area > thin * longest_squared)) continue;

        // Corners 0 and 1 of the triangles 0, p1, p2 and 0, a, b; the third takes up what they change.
        const double first = angle_change(flat.p1x, 0.0, flat.p2x, flat.p2y, ax, ay, bx, by);
        const double second = angle_change(-flat.p1x, 0.0, rest, flat.p2y, -ax, -ay, bx - ax, by - ay);
        for (const double change : {first, second, first + second}) {
            const double error = degrees * std::abs(change);
            angle_sum += error;
            angle_squares += error * error;
            result.angle_error_deg.max = std::max(result.angle_error_deg.max, error);
            corners += 1.0;
        }

        // Jacobian columns d/dx and d/dy; f_z and f_zbar from them.
        const double fx_x = ax / flat.p1x, fx_y = ay / flat.p1x;
        const double fy_x = (bx - fx_x * flat.p2x) / flat.p2y, fy_y = (by - fx_y * flat.p2x) / flat.p2y;
        const Complex fz(0.5 * (fx_x + fy_y), 0.5 * (fx_y - fy_x)), fzbar(0.5 * (fx_x - fy_y), 0.5 * (fx_y + fy_x));
        dirichlet += 0.5 * area * (fx_x * fx_x + fx_y * fx_y + fy_x * fy_x + fy_y * fy_y);
        const double fz_squared = std::norm(fz);
        const double mu = fz_squared > 0.0 ? std::sqrt(std::norm(fzbar) / fz_squared) : 1.0;
        mu_sum += area * mu;
        result.beltrami.max = std::max(result.beltrami.max, mu);

        const double log_area_ratio = std::log(std::max(std::abs(uv_area), log_area_floor) / area);
        if (surface_area == 0.0) log_origin = log_area_ratio;
        const double log_ratio = log_area_ratio - log_origin;
        surface_area += area;
        log_sum += area * log_ratio;
        log_squares += area * log_ratio * log_ratio;
        log_min = std::min(log_min, log_ratio);
        log_max = std::max(log_max, log_ratio);
    }
    if (corners > 0.0) {
        result.angle_error_deg.mean = angle_sum / corners;
        const double variance = angle_squares / corners - result.angle_error_deg.mean * result.angle_error_deg.mean;
        result.angle_error_deg.sd = std::sqrt(std::max(variance, 0.0));
    }
    if (surface_area > 0.0) {
        const double log_mean = log_sum / surface_area;
        result.beltrami.mean = mu_sum / surface_area;
        result.area.log_sd = std::sqrt(std::max(log_squares / surface_area - log_mean * log_mean, 0.0));
        result.area.log_min = log_min - log_mean;
        result.area.log_max = log_max - log_mean;
    }
    result.conformal_energy = dirichlet - image_area;
    return result;
}

}  // namespace koebe
