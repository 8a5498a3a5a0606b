// Polygons of several triangles in the UVs of a sphere.
#pragma once

#include "sphere/sphere_map.h"

#include <vector>

namespace koebe {

/// What sphere_layout knows of each face, 1 or 0.
struct LayoutMarks {
    std::vector<char> crossing, torn;  ///< (F)
};

/// Puts the triangles of each polygon side by side: from the largest one on, each goes over the inner edge where the
/// pattern continues its neighbour, by whole turns (equirectangular) or half turns and shifts (octahedral). So each
/// corner of a polygon has one place. Where the pattern does not fit round inside a polygon, as round a pole of the
/// longitudes, or where it is too long for 32-bit floats of steps of 2^-23, triangles are torn.
/// @param polygon (F) faces of one number are a polygon; empty: each face is one by itself
/// @param uv (3F, 2) of single faces, in and out @param marks in and out
void join_polygons(const Triangles& triangles, const Vertices& points, const std::vector<Index>& polygon,
                   SphereLayout layout, PlanarPoints& uv, LayoutMarks& marks);

}  // namespace koebe
