// The energy of one face in a foldover-free map, and its derivatives by the face's corners.
#pragma once

#include "core/types.h"
#include "planar/planar_predicates.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace koebe {

namespace detail {

inline Complex product(Complex a, Complex b)  // without the library's test for infinities
{
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace detail

/// The linear map z -> like z + unlike conj(z) from a face's wanted shape to its image.
struct FaceMap {
    Complex like, unlike;
    double determinant() const { return std::norm(like) - std::norm(unlike); }
    double squared_norm() const { return 2.0 * (std::norm(like) + std::norm(unlike)); }
};

/// A face's wanted shape, as three numbers. `like` of the map is the sum of these numbers times the corners of the
/// image. `unlike` is the same sum with the conjugate numbers.
struct WantedShape {
    /// @param edges columns: 0-1 and 0-2
    explicit WantedShape(const Eigen::Matrix2d& edges);

    /// @param second, third corners of the image minus its first corner, so that no digits cancel
    FaceMap map_to(Complex second, Complex third) const
    {
        return {detail::product(number[1], second) + detail::product(number[2], third),
                detail::product(std::conj(number[1]), second) + detail::product(std::conj(number[2]), third)};
    }

    std::array<Complex, 3> number;
};

/// A symmetric 2x2 matrix.
struct Symmetric {
    double m00 = 0.0, m01 = 0.0, m11 = 0.0;

    /// The matrix with its negative eigenvalues replaced by 0.
    Symmetric positive_part() const;
};

/// Derivatives of a face's term by its corners, with the Hessian made positive semidefinite. c are the shape's numbers.
/// The Hessian's block of corners k and l is a sum of two terms. The first term is the complex number
/// `like` conj(c_k) c_l + `unlike` c_k conj(c_l), as a 2x2 matrix. The second term is `along` in the plane of u and w.
/// In the direction u the |like| of the map grows, and in the direction w its |unlike|.
struct FaceDerivatives {
    double term;
    std::array<Complex, 3> gradient;
    double like, unlike;
    Symmetric along;
    std::array<Complex, 3> u, w;

    /// The Hessian's block: rows of one corner, columns of another.
    Eigen::Matrix2d block(int row, int column, const WantedShape& shape) const
    {
        const Complex a = shape.number[row], b = shape.number[column];
        const double scaled = (like + unlike) * dot(a, b);
        const double turned = (like - unlike) * (a.real() * b.imag() - a.imag() * b.real());
        const Complex p = along.m00 * u[column] + along.m01 * w[column];
        const Complex q = along.m01 * u[column] + along.m11 * w[column];
        const Complex s = u[row], t = w[row];
        Eigen::Matrix2d result;
        result << scaled + s.real() * p.real() + t.real() * q.real(),
            s.real() * p.imag() + t.real() * q.imag() - turned, s.imag() * p.real() + t.imag() * q.real() + turned,
            scaled + s.imag() * p.imag() + t.imag() * q.imag();
        return result;
    }
};

/// The term (|J|^2 + theta (D^2 + 1)) / chi(D - floor) with D = det J, or a power of it (foldover_free.h).
struct FaceEnergy {
    double area_weight, power, slack;
    double epsilon = 1.0;
    double scale = 1.0;

    double chi(double d) const
    {
        const double root = std::sqrt(epsilon * epsilon + d * d);
        return d > 0.0 ? 0.5 * (d + root) : 0.5 * epsilon * epsilon / (root - d);
    }
    double excess(double term) const { return (std::max(0.5 * term - 1.0, 0.0) + slack) / scale; }
    double operator()(const FaceMap& map, double floor) const
    {
        const double d = map.determinant();
        const double term = (map.squared_norm() + area_weight * (d * d + 1.0)) / chi(d - floor);
        return power == 1.0 ? term : std::pow(excess(term), power);
    }
    FaceDerivatives derivatives(const FaceMap& map, double floor, double weight, const WantedShape& shape) const;
};

}  // namespace koebe
