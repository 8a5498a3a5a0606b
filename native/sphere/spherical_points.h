// Points and caps of the unit sphere, from the plane and back.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <Eigen/Core>

namespace koebe {

using SpherePoint = Eigen::Vector3d;

/// A disk of the unit sphere.
struct Cap {
    SpherePoint center{0.0, 0.0, 1.0};  ///< a unit vector
    double radius = 0.0;                ///< radians, 0 to pi
};

/// Stereographic projection backwards: 0 goes to (0, 0, 1), the unit disk to the upper half, infinity to (0, 0, -1).
/// Seen from outside, what is counter-clockwise stays so.
SpherePoint on_sphere(Complex z);
Vertices on_sphere(const VectorXcd& z);

/// From a point of the sphere to the plane; (0, 0, -1) has no place there and goes to a far one.
Complex in_plane(const SpherePoint& point);

/// The cap that a disk of the plane goes to. @param outside the rest of the plane instead of the disk
Cap cap_of(const Circle& circle, bool outside);

/// The nearest point of the cap's circle.
SpherePoint onto_circle(const Cap& cap, const SpherePoint& point);

/// The exact sign of det(a, b, c): 1 where the triangle, its sides the shorter arcs, is counter-clockwise seen from
/// outside; it has less than half the sphere's area then.
int orientation(const SpherePoint& a, const SpherePoint& b, const SpherePoint& c);

/// Signed area of the triangle whose sides are the shorter arcs (Oosterom and Strackee 1983), in (-2 pi, 2 pi].
double solid_angle(const SpherePoint& a, const SpherePoint& b, const SpherePoint& c);

/// The rotation R, det R = 1, with the least sum_i w_i |R from_i - to_i|^2 (Kabsch 1976).
Eigen::Matrix3d best_rotation(const Vertices& from, const Vertices& to, const VectorXd& weights);

}  // namespace koebe
