// Puts polygons of several triangles together in the UVs of a sphere.
#pragma once

#include "sphere/sphere_map.h"

#include <vector>

namespace koebe {

/// Marks of each face by sphere_layout, 1 or 0.
struct LayoutMarks {
    std::vector<char> crossing, torn;  ///< (F)
};

/// Puts the triangles of a polygon side by side. Starts at the largest. Each next one goes over an inner edge to
/// where the pattern continues its neighbour, by whole turns (equirectangular) or half turns and shifts (octahedral).
/// So each corner of the polygon has one place. Triangles are torn where the pattern does not close inside the polygon,
/// as round a pole, or where it is too long for 32-bit floats with steps of 2^-23.
/// @param faces of the polygon @param uv (3F, 2) of single faces, in and out @param marks in and out
void join_polygon(const std::vector<Index>& faces, const Triangles& triangles, const Vertices& points,
                  SphereLayout layout, PlanarPoints& uv, LayoutMarks& marks);

}  // namespace koebe
