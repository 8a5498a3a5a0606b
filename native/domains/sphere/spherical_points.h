// Points and caps of the unit sphere, and their projections to the plane.
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

/// Inverse stereographic projection: 0 goes to (0, 0, 1), the unit disk to the upper half, infinity to (0, 0, -1).
/// Counter-clockwise stays counter-clockwise, seen from outside.
SpherePoint on_sphere(Complex z);
Vertices on_sphere(const VectorXcd& z);

/// Stereographic projection to the plane; (0, 0, -1) goes to a far point.
Complex in_plane(const SpherePoint& point);

/// The image of a disk of the plane as a cap. @param outside take the rest of the plane instead of the disk
Cap cap_of(const Circle& circle, bool outside);

/// The nearest point of the cap's circle.
SpherePoint onto_circle(const Cap& cap, const SpherePoint& point);

/// The exact sign of det(a, b, c): 1 where the triangle with the shorter arcs as sides is counter-clockwise seen from
/// outside, and has less than half the sphere's area.
int orientation(const SpherePoint& a, const SpherePoint& b, const SpherePoint& c);

/// Signed area of the triangle with the shorter arcs as sides (Oosterom and Strackee 1983), in (-2 pi, 2 pi].
double solid_angle(const SpherePoint& a, const SpherePoint& b, const SpherePoint& c);

/// The rotation R, det R = 1, with the least sum_i w_i |R from_i - to_i|^2 (Kabsch 1976).
Eigen::Matrix3d best_rotation(const Vertices& from, const Vertices& to, const VectorXd& weights);

}  // namespace koebe
