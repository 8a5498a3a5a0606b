// Texture coordinates that a corner has for itself: a seam is an edge whose two sides have others.
#pragma once

#include "core/api.h"
#include "io/polygon_mesh.h"
#include "io/polygon_triangulation.h"

namespace koebe {

/// Coordinates of the corners of the filed polygons, out of those of their triangles.
///
/// A corner has that of the triangle along the edge to the next corner. A polygon without triangles lies on one point:
/// that of one of its vertices in another polygon, or 0 where there is none.
/// @param triangle_uvs (3T, 2) of the corners of the triangulation's triangles
/// @return (C, 2) in the order of mesh.corners
KOEBE_API PlanarPoints polygon_corner_uvs(const PolygonMesh& mesh, const Triangulation& triangulation,
                                          const PlanarPoints& triangle_uvs);

}  // namespace koebe
