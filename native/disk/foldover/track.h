// The track of a loop that moves: a circle, or a straight line.
#pragma once

#include "circles/circle.h"
#include "planar/planar_predicates.h"

#include <cmath>

namespace koebe {

/// A track is itself unknown: a circle by its centre and radius, a line by its distance along its normal.
struct Track {
    bool straight = false;
    Circle circle;                       ///< unless it is straight
    Complex point, direction{1.0, 0.0};  ///< a point of the line, and its unit direction

    int unknowns() const { return straight ? 1 : 3; }

    /// The point of the track nearest to a place beside it.
    Complex nearest(Complex place) const
    {
        if (straight) return point + dot(place - point, direction) * direction;
        const Complex arm = place - circle.center;
        return circle.center + circle.radius / std::abs(arm) * arm;
    }

    /// Unit vector along the track at a place on it. The normal is this vector turned clockwise.
    Complex along(Complex place) const
    {
        if (straight) return direction;
        const Complex arm = place - circle.center;
        return Complex(-arm.imag(), arm.real()) / distance(arm, 0.0);
    }

    /// @param step the change of the unknowns
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

    /// The new place of a point that goes some way along the track while the track becomes another.
    Complex carried(Complex place, double way, const Track& after) const
    {
        if (straight) return after.point + (dot(place - point, direction) + way) * after.direction;
        const double angle = std::arg(place - circle.center) + way / circle.radius;
        return after.circle.center + std::polar(after.circle.radius, angle);
    }
};

}  // namespace koebe
