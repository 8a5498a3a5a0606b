// The Moebius map that spreads a surface most evenly over the sphere.
#pragma once

#include "core/types.h"

namespace koebe {

/// z -> (z - shift) / scale: up to rotations of the sphere every Moebius map is one of these.
struct PlaneSimilarity {
    Complex shift{0.0, 0.0};
    double scale = 1.0;

    Complex operator()(Complex z) const { return (z - shift) / scale; }
    VectorXcd operator()(const VectorXcd& z) const { return (z.array() - shift) / scale; }
};

struct SphericalBalance {
    PlaneSimilarity move;
    double gradient = 0.0;  ///< length of the mean of the points after it, 0 at the minimum
    bool balanced = false;  ///< whether that is 0 up to rounding
};

/// The similarity whose image on the sphere (on_sphere) has least area distortion: the least mean, over the surface's
/// area, of log(area on the surface / area on the sphere). That is the relative entropy of the two areas.
///
/// Up to a constant it is F(b, s) = 2 sum_v w_v log((s^2 + |z_v - b|^2) / s): each term is the Busemann function of a
/// point of the sphere, convex along the geodesics of the upper half-space, so F is convex there and its minimum is
/// the conformal barycentre of Douady and Earle (1986): the points' weighted mean is the centre of the ball. Newton's
/// method along geodesics, with a line search. There is a minimum where less than half of the weight is in any point.
/// @param z (n) finite @param weights (n) areas on the surface
SphericalBalance balance_on_sphere(const VectorXcd& z, const VectorXd& weights);

/// 2 sum_v w_v log((s^2 + |z_v - b|^2) / s) / sum_v w_v.
double spherical_unevenness(const VectorXcd& z, const VectorXd& weights, const PlaneSimilarity& move);

}  // namespace koebe
