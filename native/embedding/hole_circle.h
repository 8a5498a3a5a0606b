// Circles for the holes of a map that has none.
#pragma once

#include "circles/circle.h"

#include <vector>

namespace koebe {

enum class HoleCircle {
    through,  ///< the loop, by least squares; made smaller where it would meet another
    inside    ///< the hole, round its middle
};

/// A circle for each of some loops, apart from the others' and inside the unit circle; at the least the one that
/// touches the loop from inside, which meets nothing.
/// @param images of the loops, the unit circle's first; the holes lie on their right
/// @param fan_centres (loops) points from which all of each hole is seen; the first is not read
/// @param refit (loops) 1 where a circle is wanted; the others stay @param circles (loops), changed in place
/// @return whether the circles are apart now, those that stay too
bool fit_hole_circles(const std::vector<VectorXcd>& images, const std::vector<Complex>& fan_centres,
                      const std::vector<char>& refit, HoleCircle kind, std::vector<Circle>& circles);

}  // namespace koebe
