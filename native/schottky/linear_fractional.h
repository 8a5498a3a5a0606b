// Moebius maps of the whole plane, z -> (a z + b) / (c z + d): what the two sides of a cut handle differ by.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <array>

namespace koebe {

/// Of determinant 1: known up to the sign of all four.
struct LinearFractional {
    Complex a{1.0, 0.0}, b{0.0, 0.0}, c{0.0, 0.0}, d{1.0, 0.0};

    /// Also to the last digits beside a small isometric circle, where a z + b loses them.
    Complex operator()(Complex z) const
    {
        return std::norm(c) > 1.0 ? a / c - 1.0 / (c * (c * z + d)) : (a * z + b) / (c * z + d);
    }
    VectorXcd operator()(const VectorXcd& z) const;
    /// Image of a circle that does not go through the pole; its inside may go to the outside.
    Circle operator()(const Circle& circle) const;
    /// This map after another.
    LinearFractional operator*(const LinearFractional& first) const;
    LinearFractional inverse() const { return {d, -b, -c, a}; }

    /// The circle on which the map changes no length, |c z + d| = 1: its inside goes to the outside of that of the
    /// inverse, which is equally large. Of radius infinity if infinity stays where it is.
    Circle isometric_circle() const;
    /// The fixed point to which the map draws, as z over w; infinity has w = 0.
    std::array<Complex, 2> attracting() const;
    /// By what the map multiplies in a coordinate that is 0 at the attracting point and infinity at the other: at most
    /// 1 in size, 1 / trace^2 for a large trace.
    Complex multiplier() const;
};

/// @throws SolverError a determinant of 0 or without a finite number
LinearFractional linear_fractional(Complex a, Complex b, Complex c, Complex d);

/// The map that brings points nearest to others, by the least squares of their distances, each taken in the scale of
/// its target's neighbours. @param from, to (n >= 3) @throws SolverError no map is near
LinearFractional fitted_map(const VectorXcd& from, const VectorXcd& to);

}  // namespace koebe
