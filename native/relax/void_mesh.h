// The void round a flat surface and in its holes, triangulated.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

struct VoidMesh {
    PlanarPoints points;  ///< (V + n, 2) the surface's, the four corners of the frame, and those of the void alone
    Triangles triangles;  ///< counter-clockwise, of the void alone
};

/// A frame round the surface, and all between it and the loops, and inside of inner loops.
/// @param loops simple and apart; the one that encloses most is the outer one
/// @throws InputError if they are not
VoidMesh void_mesh(const std::vector<VertexLoop>& loops, const PlanarPoints& points);

}  // namespace koebe
