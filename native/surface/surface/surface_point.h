// Points of a surface: a triangle and barycentric coordinates in it.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct SurfacePoint {
    Index face = 0;
    Eigen::RowVector3d weights{1.0, 0.0, 0.0};  ///< of the face's corners: >= 0, sum 1

    /// The value there of a field with a row for each vertex.
    template <typename Rows>
    auto of(const Rows& rows, const Triangles& triangles) const
    {
        return (weights[0] * rows.row(triangles(face, 0)) + weights[1] * rows.row(triangles(face, 1)) +
                weights[2] * rows.row(triangles(face, 2)))
            .eval();
    }
};

/// A point as a user names it.
struct NamedPoint {
    Index vertex = -1;                                         ///< counted from 0; or -1: use the position
    Eigen::RowVector3d position = Eigen::RowVector3d::Zero();  ///< its nearest point is meant, in units of the vertices
};

/// @throws InputError with their numbers as landmarks: vertices that do not exist or belong to no face; positions that
/// are not finite, or farther from the surface than 1 % of the diagonal of its bounding box
KOEBE_API std::vector<SurfacePoint> surface_points(const Vertices& vertices, const Triangles& triangles,
                                                   const std::vector<NamedPoint>& points);

}  // namespace koebe
