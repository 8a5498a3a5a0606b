// One edge flip of an intrinsic triangulation.
#pragma once

#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// Replaces edge a-b of the quadrilateral a d b c by edge c-d. Half-edge h runs from a to b. The two faces keep their
/// rows. Their sides keep lengths and twins, also where two sides of the same two faces are glued to each other.
/// @param h has a twin, in another face @param diagonal the length of c-d
void flip_edge(Triangles& triangles, EdgeLengths& lengths, std::vector<Index>& twin, Index h, double diagonal);

}  // namespace koebe
