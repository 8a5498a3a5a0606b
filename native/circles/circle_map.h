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
    /// Loops with another circle than the surface's: shrunk because it met another circle; lost, as the image is too
    /// small or too far from round; replaced, so that no face turns over.
    std::vector<Index> shrunk, lost, replaced;
};

}  // namespace koebe
