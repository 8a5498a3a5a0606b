// Polygons that are convex on the surface stay convex in the UVs, so that any program may triangulate them in its way.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "core/warning.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// The polygons of a surface, each made of triangles.
struct SurfacePolygons {
    const Vertices& vertices;           ///< (V, 3) in any unit
    const Triangles& triangles;         ///< (F, 3)
    const std::vector<Index>& polygon;  ///< (F) triangles of one number are one polygon; empty: there are none
    const std::vector<Index>& turned;   ///< faces that the map has in the other orientation
    std::vector<Index> held = {};       ///< vertices that stay in place
    bool periodic = false;              ///< sides of cuts that differ by a translation are one place
    std::vector<Index> left_out = {};   ///< faces that are drawn like others, instead of mapped
    bool free_rims = false;  ///< loops and sides of cuts move, too; the caller checks that the map stays one to one
};

/// Finds the polygons that are convex on the surface, but not in the UVs.
///
/// A polygon of four corners or more is convex on the surface if each corner, projected onto the plane of the polygon's
/// area vector, turns left by a triangle of at least 1e-6 of the polygon's area, and the corners go round once. It is
/// convex in the UVs if all triangles of three of its corners in order have a positive area with u and v as 32-bit
/// floats. Polygons that are not simple, for example with a slit, are not convex on the surface.
/// @param uv (3F, 2) u and v of corner 3 f + k
/// @return the lowest triangle of each such polygon, ascending
KOEBE_API std::vector<Index> concave_polygons(const SurfacePolygons& surface, const PlanarPoints& uv);

/// Moves vertices inside the map until the concave polygons are convex, as far as possible.
///
/// Around such polygons the map is minimized as in untangle. Triangles keep their shapes if they can. The corner
/// triangles of all polygons that are convex on the surface take part with a small weight, so that none of them may
/// turn over. New places are kept if fewer polygons are concave as stored, and no triangle is turned over. The sides of
/// cuts do not move, so the map stays one to one.
/// @param uv (3F, 2) moved in place
/// @return whether anything has moved
/// @throws Cancelled
bool mend_polygons(const SurfacePolygons& surface, PlanarPoints& uv, const ExecutionContext& context);

/// Warns of the concave polygons, if any.
void warn_concave_polygons(const SurfacePolygons& surface, const PlanarPoints& uv, std::vector<Warning>& warnings);

/// Mends a map of the vertices into the unit disk. @param points (V, 2) moved in place
bool mend_disk_polygons(const SurfacePolygons& surface, PlanarPoints& points, const ExecutionContext& context);

/// (3F, 2) u and v of all corners of a map into the unit disk.
PlanarPoints disk_corner_uvs(const Triangles& triangles, const PlanarPoints& points);

}  // namespace koebe
