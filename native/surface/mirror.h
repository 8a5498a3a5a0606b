// Surfaces that are their own mirror images.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// Faces and vertices and their mirror images. Of quadrilaterals the diagonals need not correspond: polygons do.
struct Mirror {
    std::vector<Index> group;   ///< (F) the polygon of each face, from 0 on
    std::vector<Index> image;   ///< of each polygon; empty: the surface is no mirror image of itself
    std::vector<double> side;   ///< of each polygon: its signed distance from the plane, minus that of its image
    std::vector<Index> vertex;  ///< (V) image of each, -1 of one without a face; empty where the surface is torn
                                ///< otherwise on one side than on the other
};

/// Looks for a plane through the mean of the polygons' middles, across one of the coordinates' axes or of the spread of
/// these middles: every polygon has a mirror image that is another one or itself, corner by corner, to 1e-4 of the
/// diagonal of the box round the surface. A plane with most of the surface in it is none.
/// @param vertices (V, 3), any unit @param triangles (F, 3) @param polygon (F) any numbers, or empty: each face is one
KOEBE_API Mirror find_mirror(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon);

}  // namespace koebe
