// A boundary loop after a map that takes it to a circle.
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct MappedLoop {
    VertexLoop vertices;            ///< in order from the lowest number, the surface on the left
    Roundness roundness;            ///< of the loop's image before it was put on its circle
    std::vector<Index> off_circle;  ///< vertices that are not on the circle, ascending
};

}  // namespace koebe
