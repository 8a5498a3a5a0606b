#include "foldover/face_energy.h"

#include <Eigen/LU>

namespace koebe {

WantedShape::WantedShape(const Eigen::Matrix2d& edges)
{
    const Eigen::Matrix2d s = 0.5 * edges.inverse();
    number[1] = {s(0, 0), -s(0, 1)};
    number[2] = {s(1, 0), -s(1, 1)};
    number[0] = -number[1] - number[2];
}

Symmetric Symmetric::positive_part() const
{
    const double mean = 0.5 * (m00 + m11), half = 0.5 * (m00 - m11), spread = std::sqrt(half * half + m01 * m01);
    const double large = mean + spread, small = mean - spread;
    if (small >= 0.0) return *this;
    if (!(large > 0.0)) return {};
    const double factor = 0.5 * large / spread;
    return {factor * (spread + half), factor * m01, factor * (spread - half)};
}

/// In the real and imaginary parts of `like` and `unlike` the Hessian has the eigenvalues 4 / chi +- twice the slope by
/// the determinant, except in the plane in which their sizes p and q grow: there it is a 2x2 matrix.
FaceDerivatives FaceEnergy::derivatives(const FaceMap& map, double floor, double weight, const WantedShape& shape) const
{
    const double p = std::sqrt(std::norm(map.like)), q = std::sqrt(std::norm(map.unlike)), d = map.determinant();
    const Complex along_like = p > 0.0 ? map.like / p : Complex(1.0, 0.0);
    const Complex along_unlike = q > 0.0 ? map.unlike / q : Complex(1.0, 0.0);
    const double root = std::sqrt(epsilon * epsilon + (d - floor) * (d - floor)), chi_now = chi(d - floor);
    const double chi_slope = chi_now / root, chi_bend = 0.5 * epsilon * epsilon / (root * root * root);
    const double n = map.squared_norm() + area_weight * (d * d + 1.0), inverse = 1.0 / chi_now;
    const double slope = -chi_slope * inverse * inverse;
    const double bend = 2.0 * chi_slope * chi_slope * inverse * inverse * inverse - chi_bend * inverse * inverse;
    // Derivatives by p and by q of the determinant, of n, and of the term.
    const double d0 = 2.0 * p, d1 = -2.0 * q;
    const double n0 = 4.0 * p + 2.0 * area_weight * d * d0, n1 = 4.0 * q + 2.0 * area_weight * d * d1;
    const double g0 = inverse * n0 + n * slope * d0, g1 = inverse * n1 + n * slope * d1;
    const double by_square = 2.0 * area_weight * inverse + n * bend;
    const double by_determinant = 2.0 * (2.0 * area_weight * d * inverse + n * slope);
    const double like = 4.0 * inverse + by_determinant, unlike = 4.0 * inverse - by_determinant;
    Symmetric plane{like + by_square * d0 * d0 + 2.0 * slope * n0 * d0,
                    by_square * d0 * d1 + slope * (n0 * d1 + d0 * n1),
                    unlike + by_square * d1 * d1 + 2.0 * slope * n1 * d1};
    double value = n * inverse, first = 1.0;
    if (power != 1.0) {
        const double t = excess(value);
        first = 0.5 * power / scale * std::pow(t, power - 1.0);
        const double second = 0.25 * power * (power - 1.0) / (scale * scale) * std::pow(t, power - 2.0);
        plane = {first * plane.m00 + second * g0 * g0, first * plane.m01 + second * g0 * g1,
                 first * plane.m11 + second * g1 * g1};
        value = std::pow(t, power);
    }
    plane = plane.positive_part();
    FaceDerivatives result;
    result.term = weight * value;
    result.like = weight * std::max(first * like, 0.0);
    result.unlike = weight * std::max(first * unlike, 0.0);
    result.along = {weight * plane.m00 - result.like, weight * plane.m01, weight * plane.m11 - result.unlike};
    for (int k = 0; k < 3; ++k) {
        result.u[k] = detail::product(std::conj(shape.number[k]), along_like);
        result.w[k] = detail::product(shape.number[k], along_unlike);
        result.gradient[k] = weight * first * (g0 * result.u[k] + g1 * result.w[k]);
    }
    return result;
}

}  // namespace koebe
