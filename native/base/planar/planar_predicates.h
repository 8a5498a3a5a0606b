// Small measures and tests on points of the plane.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <cmath>

namespace koebe {

/// a x b: twice the signed area of the triangle 0, a, b.
inline double cross(Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); }

inline double dot(Complex a, Complex b) { return a.real() * b.real() + a.imag() * b.imag(); }

/// a - b|, rounded alike everywhere. The last bit of std::abs differs between C libraries, and a mesh may depend on it.
inline double distance(Complex a, Complex b) { return std::sqrt(std::norm(a - b)); }

/// Whether the closed segments a-b and c-d have a common point, up to round-off.
inline bool segments_meet(Complex a, Complex b, Complex c, Complex d)
{
    const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
    const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
    if ((c_side > 0.0 && d_side > 0.0) || (c_side < 0.0 && d_side < 0.0)) return false;
    if ((a_side > 0.0 && b_side > 0.0) || (a_side < 0.0 && b_side < 0.0)) return false;
    if (c_side != 0.0 || d_side != 0.0 || a_side != 0.0 || b_side != 0.0) return true;
    const double u = ((c - a) * std::conj(b - a)).real(), v = ((d - a) * std::conj(b - a)).real();
    const double length = std::norm(b - a);  // collinear: test whether the intervals overlap
    return std::max(u, v) >= 0.0 && std::min(u, v) <= length;
}

/// The area of a face in the plane, negative if it is turned over. @param points (V, 2) @param triangles (F, 3)
inline double signed_area(const PlanarPoints& points, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector2d a = points.row(triangles(f, 1)) - points.row(triangles(f, 0));
    const Eigen::RowVector2d b = points.row(triangles(f, 2)) - points.row(triangles(f, 0));
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

/// The same for a face whose corners are rows 3 f to 3 f + 2. @param corners (3F, 2)
inline double signed_corner_area(const PlanarPoints& corners, Eigen::Index f)
{
    const Eigen::RowVector2d a = corners.row(3 * f + 1) - corners.row(3 * f);
    const Eigen::RowVector2d b = corners.row(3 * f + 2) - corners.row(3 * f);
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

/// Width and height of the smallest rectangle along the axes round the points (V, 2).
inline Eigen::RowVector2d box_size(const PlanarPoints& points)
{
    return points.colwise().maxCoeff() - points.colwise().minCoeff();
}

}  // namespace koebe
