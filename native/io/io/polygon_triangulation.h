// Cuts filed polygons into triangles for the computation.
#pragma once

#include "core/api.h"
#include "io/polygon_mesh.h"

#include <vector>

namespace koebe {

struct Triangulation {
    Triangles triangles;           ///< with the polygons' vertices and orientation, in the order of the faces
    std::vector<Index> face;       ///< the filed face of each triangle
    std::vector<Index> collapsed;  ///< faces of fewer than three different vertices; they have no triangles
    std::vector<Index> uncut;      ///< polygons that cannot be cut, if allowed; they have no triangles
};

/// Cuts every polygon into triangles without new vertices.
///
/// A vertex repeated at once (1 2 2 3) counts once. A quadrilateral is cut along the diagonal that leaves both
/// triangles on the polygon's side, with an area; if both diagonals do, along the shorter. Larger polygons, flat or
/// not, convex or not, get the triangulation of least bend and area [Liepa, Filling Holes in Meshes, 2003; CGAL
/// triangulate_hole_polyline]. If a triangle of it, seen along the polygon's area vector, is turned over or has no
/// area, they get the constrained Delaunay triangulation of that view, unless their sides meet there. A polygon may go
/// round a hole through a slit, whose two vertices it names twice.
///
/// @param mesh with finite vertices and indices in range
/// @param refuse false: a polygon that cannot be cut gets no triangles
/// @throws InputError a polygon that cannot be cut, for example one that goes to and fro (1 2 1 3) (elements: faces)
KOEBE_API Triangulation triangulate(const PolygonMesh& mesh, bool refuse = true);

}  // namespace koebe
