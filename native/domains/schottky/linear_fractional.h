// Moebius maps of the whole plane, z -> (a z + b) / (c z + d). They relate the two sides of a cut handle.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <array>

namespace koebe {

/// A Moebius map with determinant 1, known up to the sign of all four numbers.
struct LinearFractional {
    Complex a{1.0, 0.0}, b{0.0, 0.0}, c{0.0, 0.0}, d{1.0, 0.0};

    /// Accurate to the last digits near a small isometric circle, where a z + b loses them.
    Complex operator()(Complex z) const
    {
        return std::norm(c) > 1.0 ? a / c - 1.0 / (c * (c * z + d)) : (a * z + b) / (c * z + d);
    }
    VectorXcd operator()(const VectorXcd& z) const;
    /// Image of a circle that does not pass through the pole. Its inside may go to the outside.
    Circle operator()(const Circle& circle) const;
    /// This map after `first`.
    LinearFractional operator*(const LinearFractional& first) const;
    LinearFractional inverse() const { return {d, -b, -c, a}; }

    /// The circle where the map changes no length, |c z + d| = 1. Its inside goes to the outside of the inverse's
    /// isometric circle, which is equally large. The radius is infinite if infinity is a fixed point.
    Circle isometric_circle() const;
    /// The attracting fixed point, as z over w; infinity has w = 0.
    std::array<Complex, 2> attracting() const;
    /// The factor of the map in a coordinate that is 0 at the attracting fixed point and infinity at the other: at most
    /// 1 in size, 1 / trace^2 for a large trace.
    Complex multiplier() const;
};

/// @throws SolverError the determinant is 0 or not finite
LinearFractional linear_fractional(Complex a, Complex b, Complex c, Complex d);

/// The map that brings points nearest to others, by least squares of their distances, each in the scale of its target's
/// neighbours. @param from, to (n >= 3) @throws SolverError no map is near
LinearFractional fitted_map(const VectorXcd& from, const VectorXcd& to);

}  // namespace koebe
