// The deepest vertex of a surface: the maximum of the torsion function, K u = area with u = 0 on the boundary.
#pragma once

#include "linear/condensed_laplacian.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// @param surface condensed to its boundary @param areas (V) area around each vertex
Index deepest_vertex(BoundarySolver& surface, const VectorXd& areas);

/// Finds the deepest vertex of a surface whose Laplacian is not at hand.
/// @param outer (V) 1 for boundary vertices and unused vertices @return -1 without inner vertices
Index deepest_vertex(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<char>& outer);

}  // namespace koebe
