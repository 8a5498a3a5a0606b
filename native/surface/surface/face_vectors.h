// Normals of faces, angles round vertices, and the outer side of a surface.
#pragma once

#include "core/types.h"

#include <Eigen/Geometry>

namespace koebe {

/// A vector as long as twice the face's area, on the side from which the face is counter-clockwise.
inline Eigen::RowVector3d twice_area_vector(const Vertices& vertices, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector3d a = vertices.row(triangles(f, 0));
    return (vertices.row(triangles(f, 1)) - a).cross(vertices.row(triangles(f, 2)) - a);
}

/// (V) the sum of the angles of the faces at each vertex, in radians.
VectorXd angle_sums(const Vertices& vertices, const Triangles& triangles);

/// 1 if most of the area faces away from the middle of the vertices, else -1.
double outer_side(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
