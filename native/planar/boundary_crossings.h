// Boundary loops of a planar map that cross themselves or each other.
#pragma once

#include "core/types.h"

#include <utility>
#include <vector>

namespace koebe {

/// Pairs of loop edges that meet without sharing a vertex, each edge named by the vertex it starts from. A map whose
/// triangles are all upright, whose loops are simple and apart and of which none is turned is one to one: the winding
/// numbers of its boundary count the preimages of a point, and they are 1 inside and 0 outside.
/// @param points (V, 2) @param shortest edges shorter than this, in the unit of the points, are not looked at
std::vector<std::pair<Index, Index>> crossing_boundary_edges(const std::vector<VertexLoop>& loops,
                                                             const PlanarPoints& points, double shortest);

/// Of a loop that runs counter-clockwise positive.
double enclosed_area(const VertexLoop& loop, const PlanarPoints& points);

/// Loops that run round their hole as the outer one runs round all: inside such a one the map covers the plane twice.
/// @param loops boundary loops of one oriented surface @param shortest width of what encloses no area
std::vector<int> turned_loops(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest);

}  // namespace koebe
