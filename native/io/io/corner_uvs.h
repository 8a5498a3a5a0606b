// Texture coordinates per corner: a seam is an edge whose two sides have different ones.
#pragma once

#include "core/api.h"
#include "io/polygon_mesh.h"
#include "io/polygon_triangulation.h"

namespace koebe {

/// Makes coordinates of the polygons' corners from those of their triangles.
///
/// A corner takes the coordinates of the triangle along the edge to the next corner. A polygon without triangles lies
/// at one point: of one of its vertices in another polygon, or 0.
/// @param triangle_uvs (3T, 2) of the corners of the triangulation's triangles
/// @return (C, 2) in the order of mesh.corners
KOEBE_API PlanarPoints polygon_corner_uvs(const PolygonMesh& mesh, const Triangulation& triangulation,
                                          const PlanarPoints& triangle_uvs);

/// The reverse: (3T, 2) of the triangles' corners. @param corner_uvs (C, 2) in the order of mesh.corners
KOEBE_API PlanarPoints triangle_corner_uvs(const PolygonMesh& mesh, const Triangulation& triangulation,
                                           const PlanarPoints& corner_uvs);

}  // namespace koebe
