// A mapped surface without the vertices that no face uses.
#pragma once

#include "circles/circle.h"
#include "transfer/landmark_map.h"

#include <vector>

namespace koebe {

/// Faces keep their numbers.
struct CompactDomain {
    std::vector<Index> original;  ///< vertex of the surface for each vertex
    MappedSurface surface;
    std::vector<VertexLoop> loops;
    std::vector<Index> off_circle;  ///< loop vertices off their circles, ascending
    std::vector<Circle> circles;    ///< of the loops
    VectorXd areas;                 ///< (F) on the surface
};

CompactDomain compact(const MappedSurface& surface);

}  // namespace koebe
