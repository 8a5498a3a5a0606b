// Finds boundary loops of a planar map that cross themselves or each other.
#pragma once

#include "core/types.h"

#include <span>
#include <utility>
#include <vector>

namespace koebe {

/// Pairs of loop edges that meet without sharing a vertex, each edge named by its first vertex. A map is one to one if
/// all its triangles are upright, its loops are simple and apart, and no loop is turned: the winding numbers of its
/// boundary count the preimages of a point, and they are 1 inside and 0 outside.
/// @param points (V, 2) @param shortest edges shorter than this, in the unit of the points, are ignored
std::vector<std::pair<Index, Index>> crossing_boundary_edges(const std::vector<VertexLoop>& loops,
                                                             const PlanarPoints& points, double shortest);

/// Whether there is such a pair. It ends with the first one: where needles lie over each other, there are as many as
/// the square of their number.
bool loops_cross(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest);

/// Places of loops, and the length from which edges count.
struct LoopDrawing {
    const PlanarPoints& points;  ///< (V, 2)
    double shortest;
};

/// Whether there is such a pair in one of some drawings that are nearly alike. Edges that are far apart in all are
/// found once. @param drawings at most 3 @param reach most distance of a coordinate from that in the first drawing,
/// if a drawing is shifted as a whole so that it is least
bool loops_cross(const std::vector<VertexLoop>& loops, std::span<const LoopDrawing> drawings, double reach);

/// The enclosed area, positive for a counter-clockwise loop.
double enclosed_area(const VertexLoop& loop, const PlanarPoints& points);

/// Holes whose loop runs round as the outer loop does: inside such a loop the map covers the plane twice.
/// @param loops boundary loops of one oriented surface @param shortest a narrower loop encloses no area
std::vector<int> turned_loops(const std::vector<VertexLoop>& loops, const PlanarPoints& points, double shortest);

}  // namespace koebe
