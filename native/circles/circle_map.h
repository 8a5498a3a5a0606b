// A surface mapped to the unit disk with its loops on circles: what the stages of a uniformization hand on.
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct CircleMap {
    PlanarPoints uv;                   ///< (V, 2) points of the closed unit disk
    std::vector<Circle> circles;       ///< of the loops, apart from each other, the unit circle first
    std::vector<Roundness> roundness;  ///< of each loop's image before it was put on its circle
    std::vector<Index> off_circle;     ///< loop vertices that are not on their circles, rising
    /// Loops whose circles are not the surface's: made smaller as they met another; without meaning, the image too
    /// small or too far from round; others than the iteration's, on which no face turns over.
    std::vector<Index> shrunk, lost, replaced;
};

}  // namespace koebe
