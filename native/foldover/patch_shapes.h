// What shape and size the faces of a tangled neighbourhood should have.
#pragma once

#include "core/types.h"

#include <Eigen/Core>

#include <vector>

namespace koebe {

/// What the faces of a patch are drawn towards: the surface's as large as the map has them around, equilateral ones, or
/// the surface's as they are.
enum class PatchShape { surface, equilateral, true_size };

struct PatchShapes {
    std::vector<Eigen::Matrix2d> references;  ///< columns: edges 0-1 and 0-2 of each face, counter-clockwise
    VectorXd areas;                           ///< of each, in the unit of the plane
};

/// Areas are the surface's by the local conformal factor, which is taken from edges, as the areas of the map may be
/// folded, but for true size; for equilateral shapes, their mean around each face. A face is at least 1e-2 of its
/// longest edge high.
/// @param uv (V, 2) the map as it is @param faces the faces to take
PatchShapes patch_shapes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                         const std::vector<Index>& faces, PatchShape shape);

}  // namespace koebe
