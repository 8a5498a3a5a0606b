// Automorphisms of the unit disk.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// z -> turn (z - a) / (1 - conj(a) z), |a| < 1, |turn| = 1: every automorphism of the unit disk.
struct Moebius {
    Complex a{0.0, 0.0};
    Complex turn{1.0, 0.0};

    Complex operator()(Complex z) const { return turn * (z - a) / (1.0 - std::conj(a) * z); }
    KOEBE_API VectorXcd operator()(const VectorXcd& z) const;
    /// Image of a circle inside the disk, which is a circle.
    Circle operator()(const Circle& circle) const;
    /// This map after `first`.
    Moebius operator*(const Moebius& first) const;
    Moebius inverse() const { return {-a * turn, std::conj(turn)}; }
};

/// The automorphism that moves a circle inside the disk to the centre 0.
Moebius center_circle(const Circle& circle);

}  // namespace koebe
