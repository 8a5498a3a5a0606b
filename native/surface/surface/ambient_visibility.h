// How much of a surface is seen from outside.
#pragma once

#include "core/types.h"

namespace koebe {

/// The share of the directions on the outer side of each vertex, weighted by their cosine with the normal, in which
/// nothing of the surface is in the way: 1 on convex surfaces, less in hollows and between limbs. The outer side is the
/// side on which most of the area faces away from the middle.
/// In a mesh of many vertices most of them have what a neighbour sees.
/// @param vertices (V, 3) @param triangles (F, 3) @return (V) from 0 to 1; 1 for vertices without area
VectorXd ambient_visibility(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
