// Finds the mirror symmetry of a surface.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// The mirror images of polygons and vertices. Diagonals of quadrilaterals need not correspond.
struct Mirror {
    std::vector<Index> group;   ///< (F) the polygon of each face, numbered from 0
    std::vector<Index> image;   ///< mirror image of each polygon; empty: the surface is not symmetric
    std::vector<double> side;   ///< of each polygon: its signed distance from the plane, minus that of its image
    std::vector<Index> vertex;  ///< (V) mirror image of each vertex, -1 for an unused one; empty where one side of the
                                ///< surface is torn otherwise than the other
};

/// Looks for a mirror plane through the mean of the polygons' middles. The plane is perpendicular to a coordinate axis
/// or to a principal axis of these middles. Every polygon has a mirror image, another one or itself, corner by corner,
/// to 1e-4 of the bounding box's diagonal. A plane that holds most of the surface does not count.
/// @param vertices (V, 3), any unit @param triangles (F, 3) @param polygon (F) any numbers; empty: each face is a
/// polygon
KOEBE_API Mirror find_mirror(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon);

}  // namespace koebe
