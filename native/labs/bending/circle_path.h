// A way of circles from one circle domain to another, on which they never meet.
#pragma once

#include "circles/circle.h"

#include <vector>

namespace koebe {

/// Circles that move at the same time. Centres move straight, or on bows: parabolas in the plane to which
/// z / sqrt(1 - |z|^2) takes the disk, so that no bow leaves the disk. Radii change in equal factors. Between two
/// circles that would meet, or come near the unit circle, both are made smaller for the time.
class CirclePath {
public:
    /// @param begin, end the unit circle first; circles apart
    /// @param bows heights of the bows over their chords, positive to the left; 0: straight
    CirclePath(std::vector<Circle> begin, std::vector<Circle> end, std::vector<double> bows);

    /// The circles at a share of the way from 0 to 1, apart.
    std::vector<Circle> at(double share) const;

    /// How small circles get for lack of room, as a share of the room that they want: 0 if centres meet, at most 1.
    double room() const;

    const std::vector<double>& bows() const { return bows_; }
    bool straight() const;

private:
    std::vector<Complex> centers_at(double share) const;

    std::vector<Circle> begin_, end_;
    std::vector<double> bows_;
};

/// Ways to try, the best one first. The straight way is first if it leaves enough room. Two points that change places
/// bow to the same side each, so they turn about each other. Then bows are searched at random, from a fixed seed.
std::vector<CirclePath> paths_between(const std::vector<Circle>& begin, const std::vector<Circle>& end);

}  // namespace koebe
