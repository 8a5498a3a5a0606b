// Planes in which a surface is its own mirror image, or nearly so.
#pragma once

#include "core/types.h"

#include <optional>
#include <vector>

namespace koebe {

struct MirrorPlane {
    Eigen::RowVector3d normal, center;
    double distance(const Eigen::RowVector3d& point) const { return normal.dot(point - center); }
    Eigen::RowVector3d image(const Eigen::RowVector3d& point) const { return point - 2.0 * distance(point) * normal; }
};

/// Planes across the coordinate axes and across the principal axes of some points, where these are distinct. They go
/// through the mean. @param points (n, 3) @param weights (n)
std::vector<MirrorPlane> possible_mirrors(const Vertices& points, const VectorXd& weights);

/// The plane between vertices and their mirror images. @param image (V) as in Mirror, not empty
MirrorPlane plane_between(const Vertices& vertices, const std::vector<Index>& image);

/// The plane in which a surface is most nearly its own mirror image, whatever its triangulation: points of the surface
/// have their images on the surface, to 1 % of the bounding box's diagonal in the mean. Begins with possible_mirrors.
/// @param vertices (V, 3) @param triangles (F, 3), F >= 1 @return no value if there is none
std::optional<MirrorPlane> nearly_mirror(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
