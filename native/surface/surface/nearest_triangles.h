// Finds the triangles of a mesh that are nearest to given points.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

struct PlacesInTriangles {
    Eigen::VectorX<Index> face;  ///< (n) the nearest triangle of each point
    Vertices weights;            ///< (n, 3) barycentric coordinates of its nearest point: >= 0, sum 1
    VectorXd distance;           ///< (n) from the point to the triangle; 0 within rounding on the mesh
};

/// Barycentric coordinates of the point of a triangle in space that is nearest to a point: >= 0, sum 1. At a corner
/// they are 1 and 0. @param corners a row each
Eigen::RowVector3d weights_in_triangle(const Eigen::RowVector3d& point, const Eigen::Matrix3d& corners);

/// Uses CGAL's tree of bounding boxes. Triangles without area count as segments or points.
/// @param corners (V, 2) finite @param triangles (F, 3), F >= 1 @param points (n, 2) finite
KOEBE_API PlacesInTriangles nearest_triangles(const PlanarPoints& corners, const Triangles& triangles,
                                              const PlanarPoints& points);

/// Finds nearest triangles in space. @param corners (V, 3) @param points (n, 3)
PlacesInTriangles nearest_triangles(const Vertices& corners, const Triangles& triangles, const Vertices& points);

}  // namespace koebe
