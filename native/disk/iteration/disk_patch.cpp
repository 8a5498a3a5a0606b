#include "iteration/disk_patch.h"

#include "core/numbering.h"
#include "holes/fan_filling.h"
#include "planar/planar_predicates.h"
#include "surface/harmonic_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double fan_margin = 1e-6;  // of the mean edge length
constexpr double gradation = 0.25;   // growth of the edge length per distance from the rim, dimensionless
constexpr double worst_angle = 0.5;  // a mesh is made anew when its smallest angle falls below this share of its first

// Edges of a rim up to which its disk is as fine inside as at the rim: an even mesh has m^2 / 5 faces. Behind longer
// rims edges grow to those of a rim of this length, faster by a factor. Separations of circles change by 1e-5 there,
// on meshes whose own error is 2e-3.
constexpr Index even_rim = 128;
constexpr double steeper = 2.0;

/// Smallest angle of all triangles, radians; negative if a triangle is flipped.
double smallest_angle(const VectorXcd& z, const Triangles& triangles)
{
    double smallest = std::numbers::pi;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Complex here = z[triangles(f, k)];
            const double angle =
                std::arg((z[triangles(f, (k + 2) % 3)] - here) / (z[triangles(f, (k + 1) % 3)] - here));
            smallest = std::isfinite(angle) ? std::min(smallest, angle) : -std::numbers::pi;
        }
    return smallest;
}

/// Rounds coordinates to 26 binary digits. The triangles of a mesh depend on the last bits of its points, most of all
/// for points of a circle. Without rounding, the unit of length would show in the result.
VectorXcd on_grid(const VectorXcd& points)
{
    constexpr double digits = 1 << 26;
    return points.unaryExpr([](const Complex& z) {
        return Complex(std::round(z.real() * digits) / digits, std::round(z.imag() * digits) / digits);
    });
}

double mean_edge(const VectorXcd& polygon)
{
    double length = 0.0;
    for (Eigen::Index i = 0; i < polygon.size(); ++i) length += distance(polygon[(i + 1) % polygon.size()], polygon[i]);
    return length / static_cast<double>(polygon.size());
}

}  // namespace

EdgeLengths planar_lengths(const VectorXcd& z, const Triangles& triangles)
{
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return edge_lengths(points, triangles);
}

DiskPatch::DiskPatch(const Vertices& loop) : rim_size_(static_cast<Index>(loop.rows()))
{
    SurfacePatch fan = fill_on_surface(loop);
    lengths_ = edge_lengths(fan.vertices, fan.triangles);
    // Vertices of a loop may lie on one line or at one point. A margin in every triangle inequality (Sharp and Crane
    // 2020) keeps the weights finite.
    const double mean = lengths_.mean();
    lengths_.array() += mean > 0.0 ? fan_margin * mean : 1.0;
    triangles_ = std::move(fan.triangles);
    vertex_count_ = static_cast<Index>(fan.vertices.rows());
}

void DiskPatch::mesh(const VectorXcd& rim)
{
    const VectorXcd polygon = on_grid(rim);
    // Edges as long as the rim's, up to even_rim edges, keep second order (the paper gives no value). The disk of loop
    // 0 may then have more faces than the surface. With 1.5 the error is up to ten times larger, with 3 it stops
    // falling.
    const double even_edge = 2.0 * std::numbers::pi / even_rim;
    PlanarMesh patch = planar_patch(polygon, {.longest = std::max(mean_edge(polygon), even_edge),
                                              .gradation = (rim_size_ > even_rim ? steeper : 1.0) * gradation});
    triangles_ = std::move(patch.triangles);
    vertex_count_ = static_cast<Index>(patch.points.size());
    lengths_ = planar_lengths(patch.points, triangles_);
    angle_when_meshed_ = smallest_angle(patch.points, triangles_);
    is_fan_ = false;
}

VectorXcd DiskPatch::harmonic_image(const VectorXcd& rim) const
{
    std::vector<Index> fixed = numbers_below(rim_size_);
    return harmonic_map(triangles_, lengths_, vertex_count_, fixed, rim);
}

void DiskPatch::refill(const VectorXcd& rim, double radius)
{
    if (is_fan_) mesh(rim);
    VectorXcd chart = harmonic_image(rim);
    if (smallest_angle(chart, triangles_) < worst_angle * angle_when_meshed_) {
        mesh(rim);
        chart = harmonic_image(rim);
    }
    lengths_ = radius * planar_lengths(chart, triangles_);
}

}  // namespace koebe
