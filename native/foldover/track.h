// What a loop stays on while it moves: a circle, or a straight line.
#pragma once

#include "circles/circle.h"
#include "planar/planar_predicates.h"

#include <cmath>

namespace koebe {

/// An unknown itself, by its centre and radius, or by its distance along its normal.
struct Track {
    bool straight = false;
    Circle circle;                       ///< unless it is straight
    Complex point, direction{1.0, 0.0};  ///< a point of a straight one, and where it leads, of length 1

    int unknowns() const { return straight ? 1 : 3; }

    /// Where a point beside the track comes to lie on it.
    Complex nearest(Complex place) const
    {
        if (straight) return point + dot(place - point, direction) * direction;
        const Complex arm = place - circle.center;
        return circle.center + circle.radius / std::abs(arm) * arm;
    }

    /// Of length 1, along the track at a place on it; the normal is this turned clockwise.
    Complex along(Complex place) const
    {
        if (straight) return direction;
        const Complex arm = place - circle.center;
        return Complex(-arm.imag(), arm.real()) / distance(arm, 0.0);
    }

    /// @param step by which the unknowns change
    Track moved(const double* step, double share) const
    {
        Track track = *this;
        if (straight) {
            track.point += Complex(0.0, -share * step[0]) * direction;
        } else {
            track.circle.center += share * Complex(step[0], step[1]);
            track.circle.radius += share * step[2];
        }
        return track;
    }

    /// Where a place on the track comes when the track becomes another and it goes some way along.
    Complex carried(Complex place, double way, const Track& after) const
    {
        if (straight) return after.point + (dot(place - point, direction) + way) * after.direction;
        const double angle = std::arg(place - circle.center) + way / circle.radius;
        return after.circle.center + std::polar(after.circle.radius, angle);
    }
};

}  // namespace koebe
