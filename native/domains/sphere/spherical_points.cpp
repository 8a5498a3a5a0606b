#include "sphere/spherical_points.h"

#include "execution/each_in_pieces.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr double least_sizes = 1e-250;  // no product underflows unseen

}  // namespace

SpherePoint on_sphere(Complex z)
{
    const double size = std::abs(z);
    if (size <= 1.0) return SpherePoint(2.0 * z.real(), 2.0 * z.imag(), 1.0 - size * size) / (1.0 + size * size);
    const Complex w = (z / size) / size;  // 1 / conj(z)
    const double square = 1.0 / size / size;
    return SpherePoint(2.0 * w.real(), 2.0 * w.imag(), square - 1.0) / (1.0 + square);
}

Vertices on_sphere(const VectorXcd& z)
{
    Vertices points(z.size(), 3);
    each_in_pieces(z.size(), [&](Eigen::Index v) { points.row(v) = on_sphere(z[v]).transpose(); });
    return points;
}

Complex in_plane(const SpherePoint& point)
{
    const Complex across(point[0], point[1]);
    if (point[2] > -0.5) return across / (1.0 + point[2]);
    const double square = std::norm(across);  // (1 - z) (1 + z), without cancellation at the pole
    return square > 1e-300 ? across * ((1.0 - point[2]) / square) : Complex(1e150, 0.0);
}

Cap cap_of(const Circle& circle, bool outside)
{
    // z - c| < r is x (2 c) + z (1 - q) > 1 + q with q = |c|^2 - r^2; that normal has the length of (1 + q, 2 r).
    const double distance = std::abs(circle.center);
    const double q = (distance - circle.radius) * (distance + circle.radius);
    Cap cap;
    cap.center = SpherePoint(2.0 * circle.center.real(), 2.0 * circle.center.imag(), 1.0 - q).normalized();
    cap.radius = std::atan2(2.0 * circle.radius, 1.0 + q);
    if (outside) {
        cap.center = -cap.center;
        cap.radius = std::atan2(2.0 * circle.radius, -(1.0 + q));
    }
    return cap;
}

SpherePoint onto_circle(const Cap& cap, const SpherePoint& point)
{
    SpherePoint across = point - cap.center * cap.center.dot(point);
    if (!(across.norm() > 0.0)) across = cap.center.unitOrthogonal();
    return (std::cos(cap.radius) * cap.center + std::sin(cap.radius) * across.normalized()).normalized();
}

int orientation(const SpherePoint& a, const SpherePoint& b, const SpherePoint& c)
{
    // det(a, b, c) = det(a, b - a, c - a), whose rounding is small beside small triangles. Where it does not tell the
    // sign, exact numbers do.
    constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();  // of the sum of sizes; the bound is 4
    const SpherePoint along = b - a, across = c - a;
    const double determinant = a.dot(along.cross(across));
    const auto size = [](double left, double right) { return std::abs(left) + std::abs(right); };
    const double sizes = std::abs(a[0]) * size(along[1] * across[2], along[2] * across[1]) +
                         std::abs(a[1]) * size(along[2] * across[0], along[0] * across[2]) +
                         std::abs(a[2]) * size(along[0] * across[1], along[1] * across[0]);
    if (sizes > least_sizes && std::abs(determinant) > rounding * sizes) return determinant > 0.0 ? 1 : -1;
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    const auto point = [](const SpherePoint& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
    return static_cast<int>(CGAL::orientation(Kernel::Point_3(0.0, 0.0, 0.0), point(a), point(b), point(c)));
}

double solid_angle(const SpherePoint& a, const SpherePoint& b, const SpherePoint& c)
{
    const SpherePoint along = b - a, across = c - a;  // differences, so that a small triangle keeps its digits
    return 2.0 * std::atan2(a.dot(along.cross(across)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

Eigen::Matrix3d best_rotation(const Vertices& from, const Vertices& to, const VectorXd& weights)
{
    const Eigen::Matrix3d moment = to.transpose() * weights.asDiagonal() * from;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1.0, 1.0, 1.0);
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace koebe
