// A surface mapped to the unit disk with its loops on circles, as passed from stage to stage.
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct CircleMap {
    PlanarPoints uv;                   ///< (V, 2) points of the closed unit disk
    std::vector<Circle> circles;       ///< of the loops, apart from each other; the unit circle first
    std::vector<Roundness> roundness;  ///< of each loop's image before it was put on its circle
    std::vector<Index> off_circle;     ///< loop vertices that are not on their circles, ascending
    /// Loops whose circle does not follow from the surface alone. Shrunk: the circle met a neighbour. Lost: the image
    /// is too small or too far from round. Replaced: faces would turn over on the circle.
    std::vector<Index> shrunk, lost, replaced;
};

}  // namespace koebe
