#include "quality/distortion.h"

#include "execution/thread_share.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace koebe {
namespace {

constexpr double log_area_floor = 1e-300;

/// Sums of the measures over some faces.
struct FaceSums {
    AngleSums angles;
    double mu_sum = 0.0, mu_max = 0.0, surface_area = 0.0, log_sum = 0.0, log_squares = 0.0;
    double dirichlet = 0.0, image_area = 0.0;
    double log_min = std::numeric_limits<double>::infinity(), log_max = -log_min;

    void add(const FaceSums& more)
    {
        angles.add(more.angles);
        mu_sum += more.mu_sum;
        mu_max = std::max(mu_max, more.mu_max);
        surface_area += more.surface_area;
        log_sum += more.log_sum;
        log_squares += more.log_squares;
        dirichlet += more.dirichlet;
        image_area += more.image_area;
        log_min = std::min(log_min, more.log_min);
        log_max = std::max(log_max, more.log_max);
    }
};

/// A face on the surface and in the plane, with its first corner at 0.
struct FacePair {
    FacePair(const FlatFaces& faces, const Triangles& triangles, const PlanarPoints& uv, Eigen::Index f)
        : flat(faces(f)),
          ax(uv(triangles(f, 1), 0) - uv(triangles(f, 0), 0)),
          ay(uv(triangles(f, 1), 1) - uv(triangles(f, 0), 1)),
          bx(uv(triangles(f, 2), 0) - uv(triangles(f, 0), 0)),
          by(uv(triangles(f, 2), 1) - uv(triangles(f, 0), 1)),
          uv_area(0.5 * (ax * by - ay * bx)),
          area(flat.area())
    {
    }

    double log_area_ratio() const { return std::log(std::max(std::abs(uv_area), log_area_floor) / area); }

    FlatTriangle flat;
    double ax, ay, bx, by, uv_area, area;
};

/// @param log_origin the variance of the logarithms is taken about this, to avoid cancellation
void add_face(const FacePair& face, double log_origin, FaceSums& sums)
{
    const FlatTriangle& flat = face.flat;
    const double ax = face.ax, ay = face.ay, bx = face.bx, by = face.by, area = face.area;
    sums.image_area += face.uv_area;
    if (!flat.has_angles()) return;

    sums.angles.add(angle_errors(flat, ax, ay, bx, by));

    // Jacobian columns d/dx and d/dy give f_z and f_zbar.
    const double fx_x = ax / flat.p1x, fx_y = ay / flat.p1x;
    const double fy_x = (bx - fx_x * flat.p2x) / flat.p2y, fy_y = (by - fx_y * flat.p2x) / flat.p2y;
    const Complex fz(0.5 * (fx_x + fy_y), 0.5 * (fx_y - fy_x)), fzbar(0.5 * (fx_x - fy_y), 0.5 * (fx_y + fy_x));
    sums.dirichlet += 0.5 * area * (fx_x * fx_x + fx_y * fx_y + fy_x * fy_x + fy_y * fy_y);
    const double fz_squared = std::norm(fz);
    const double mu = fz_squared > 0.0 ? std::sqrt(std::norm(fzbar) / fz_squared) : 1.0;
    sums.mu_sum += area * mu;
    sums.mu_max = std::max(sums.mu_max, mu);

    const double log_ratio = face.log_area_ratio() - log_origin;
    sums.surface_area += area;
    sums.log_sum += area * log_ratio;
    sums.log_squares += area * log_ratio * log_ratio;
    sums.log_min = std::min(sums.log_min, log_ratio);
    sums.log_max = std::max(sums.log_max, log_ratio);
}

FaceSums sums_over_faces(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv)
{
    constexpr std::size_t at_a_time = 65536;  // up to here one pass gives the sums
    const std::size_t faces = static_cast<std::size_t>(triangles.rows());
    const FlatFaces flat(vertices, triangles);
    double log_origin = 0.0;  // the first ratio
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (const FacePair face(flat, triangles, uv, f); face.flat.has_angles()) {
            log_origin = face.log_area_ratio();
            break;
        }
    std::vector<FaceSums> parts((faces + at_a_time - 1) / at_a_time);
    in_pieces(faces, at_a_time, [&](std::size_t begin, std::size_t end) {
        FaceSums sums;
        for (std::size_t f = begin; f < end; ++f)
            add_face(FacePair(flat, triangles, uv, static_cast<Eigen::Index>(f)), log_origin, sums);
        parts[begin / at_a_time] = sums;
    });
    FaceSums result;
    for (const FaceSums& part : parts) result.add(part);
    return result;
}

}  // namespace

ComputedDistortion measure_distortion(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv)
{
    ComputedDistortion result;
    const FaceSums sums = sums_over_faces(vertices, triangles, uv);
    result.angle_error_deg = sums.angles.error();
    result.beltrami.max = sums.mu_max;
    if (sums.surface_area > 0.0) {
        const double log_mean = sums.log_sum / sums.surface_area;
        result.beltrami.mean = sums.mu_sum / sums.surface_area;
        result.area.log_sd = std::sqrt(std::max(sums.log_squares / sums.surface_area - log_mean * log_mean, 0.0));
        result.area.log_min = sums.log_min - log_mean;
        result.area.log_max = sums.log_max - log_mean;
    }
    result.conformal_energy = sums.dirichlet - sums.image_area;
    return result;
}

ComputedDistortion measure_corner_distortion(const Vertices& vertices, const Triangles& triangles,
                                             const PlanarPoints& corners)
{
    Triangles apart(triangles.rows(), 3);
    std::iota(apart.data(), apart.data() + apart.size(), 0);
    Vertices corner_vertices(triangles.size(), 3);
    for (Eigen::Index c = 0; c < triangles.size(); ++c) corner_vertices.row(c) = vertices.row(triangles.data()[c]);
    return measure_distortion(corner_vertices, apart, corners);
}

}  // namespace koebe
