// One edge flip of an intrinsic triangulation.
#pragma once

#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// Replaces the edge a-b of the quadrilateral a d b c, given by half-edge h from a to b, by c-d. The two faces keep
/// their rows; their sides keep lengths and twins, also where a side is glued to another side of the same two faces.
/// @param h has a twin, in another face @param diagonal the length of c-d
void flip_edge(Triangles& triangles, EdgeLengths& lengths, std::vector<Index>& twin, Index h, double diagonal);

}  // namespace koebe
