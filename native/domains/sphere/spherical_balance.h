// Finds the Moebius map that spreads a surface most evenly over the sphere.
#pragma once

#include "core/types.h"

namespace koebe {

/// z -> (z - shift) / scale: every Moebius map is one of these, up to rotations of the sphere.
struct PlaneSimilarity {
    Complex shift{0.0, 0.0};
    double scale = 1.0;

    Complex operator()(Complex z) const { return (z - shift) / scale; }
    VectorXcd operator()(const VectorXcd& z) const { return (z.array() - shift) / scale; }
};

struct SphericalBalance {
    PlaneSimilarity move;
    double gradient = 0.0;  ///< length of the mean of the moved points, 0 at the minimum
    bool balanced = false;  ///< whether the gradient is 0 up to rounding
};

/// The similarity whose image on the sphere (on_sphere) has least area distortion. It minimizes the mean, over the
/// surface's area, of log(area on the surface / area on the sphere): the relative entropy of the two areas.
///
/// Up to a constant it is F(b, s) = 2 sum_v w_v log((s^2 + |z_v - b|^2) / s). Each term is the Busemann function of a
/// point of the sphere, convex along the geodesics of the upper half-space. So F is convex there, and its minimum is
/// the conformal barycentre of Douady and Earle (1986): the weighted mean of the points is the centre of the ball. Uses
/// Newton's method along geodesics with a line search. A minimum exists if each point has less than half of the weight.
/// @param z (n) finite @param weights (n) areas on the surface
SphericalBalance balance_on_sphere(const VectorXcd& z, const VectorXd& weights);

/// 2 sum_v w_v log((s^2 + |z_v - b|^2) / s) / sum_v w_v.
double spherical_unevenness(const VectorXcd& z, const VectorXd& weights, const PlaneSimilarity& move);

}  // namespace koebe
