// The void round a flat surface and in its holes, triangulated.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

struct VoidMesh {
    PlanarPoints points;  ///< (V + n, 2) points of the surface, four corners of the frame, other points of the void
    Triangles triangles;  ///< triangles of the void only, counter-clockwise
};

/// Triangulates the space between a frame and the outer loop, and the inside of each inner loop.
/// @param loops simple and apart; the loop that encloses most is the outer loop
/// @throws InputError loops that are not simple, or not apart
VoidMesh void_mesh(const std::vector<VertexLoop>& loops, const PlanarPoints& points);

}  // namespace koebe
