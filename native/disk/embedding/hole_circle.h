// Chooses circles for the holes of a map.
#pragma once

#include "circles/circle.h"

#include <vector>

namespace koebe {

enum class HoleCircle {
    through,  ///< the loop, by least squares; smaller where it would meet another circle
    inside    ///< the hole, round its middle
};

/// Chooses a circle for each of some loops, apart from the other circles and inside the unit circle. If no other choice
/// is left, the circle touches the loop from inside, and so meets no other circle.
/// @param images of the loops, the unit circle's first; the holes lie on their right
/// @param fan_centres (loops) points from which all of each hole is visible; the first is not read
/// @param refit (loops) 1 to choose a new circle; other circles stay @param circles (loops), changed in place
/// @return whether all circles are apart now
bool fit_hole_circles(const std::vector<VectorXcd>& images, const std::vector<Complex>& fan_centres,
                      const std::vector<char>& refit, HoleCircle kind, std::vector<Circle>& circles);

}  // namespace koebe
