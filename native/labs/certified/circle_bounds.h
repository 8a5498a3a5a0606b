// Circles whose places are known up to a box, and bounds of simple functions on them.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <optional>
#include <vector>

namespace koebe {

constexpr double rounded_up = 1.0 + 1e-9;  // covers the rounding of sums of numbers above 0

/// A number of the module moves one circle.
struct CircleStep {
    int circle;
    Complex center;
    double radius;
};

CircleStep step_of(Eigen::Index number);

/// The circles with this module (shape/conformal_module.h): the unit circle, a circle round 0, a circle with its centre
/// on the positive y axis, the rest. @param module (3 n - 6) for n >= 3 circles
std::vector<Circle> circles_of_module(const VectorXd& module);

/// The module after a step towards other circles, halved until no radius and no gap between two circles shrinks to less
/// than half: Newton's method stays among circle domains, and near the place where it was linear.
VectorXd moved_module(const VectorXd& module, VectorXd step);

/// Bounds of the absolute values of a function of one variable and of its first two derivatives.
struct BoundedFunction {
    double value = 0.0, first = 0.0, second = 0.0;
};

inline BoundedFunction operator+(const BoundedFunction& a, const BoundedFunction& b)
{
    return {a.value + b.value, a.first + b.first, a.second + b.second};
}

inline BoundedFunction operator*(const BoundedFunction& a, const BoundedFunction& b)
{
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + 2.0 * a.first * b.first + a.value * b.second};
}

/// How far circles may be from their places, or how fast they move.
struct CircleMotion {
    explicit CircleMotion(const VectorXd& numbers);

    std::vector<double> of_centers, of_radii;
};

/// What the functions of inner circles k = 1, 2, ... are at most on another. D = 1 - conj(c) z.
struct OnCircle {
    std::vector<BoundedFunction> ratio;      // [k - 1] r / (z - c)
    std::vector<BoundedFunction> mirrored;   // [k - 1] r z / D, its mirror image in the unit circle
    std::vector<BoundedFunction> logarithm;  // [k - 1] the sum of log |z - c| and log |D|
};

/// A part of inner circle b: all of it, or a point of it and the neighbourhood of so many radii. If stretch > 1, where
/// the angle is complex, too: in the annulus between r / stretch and r * stretch, to which each function of the angle
/// continues analytically.
struct CirclePart {
    std::size_t circle;
    double stretch = 1.0;
    std::optional<Complex> point = {};
    double neighbourhood = 0.0;
};

/// Nothing where a centre, or its mirror image, may lie on the part.
OnCircle bounds_on(const std::vector<Circle>& circles, const CirclePart& part, const CircleMotion& slack,
                   const CircleMotion& speed);

/// Whether no two circles meet, wherever they are in the box.
bool stay_apart(const std::vector<Circle>& circles, const CircleMotion& slack);

}  // namespace koebe
