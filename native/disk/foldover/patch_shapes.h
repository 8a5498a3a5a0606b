// The wanted shapes and sizes of faces in a tangled neighbourhood.
#pragma once

#include "core/types.h"

#include <Eigen/Core>

#include <vector>

namespace koebe {

/// The wanted shapes of a patch's faces: the shapes on the surface in the map's local size, equilateral shapes, or the
/// shapes on the surface in true size.
enum class PatchShape { surface, equilateral, true_size };

struct PatchShapes {
    std::vector<Eigen::Matrix2d> references;  ///< columns: edges 0-1 and 0-2 of each face, counter-clockwise
    VectorXd areas;                           ///< of each face, in the unit of the plane
};

/// Areas are the surface's areas times the local conformal factor, except for true size. The factor comes from edges,
/// as areas of the map may be folded. For equilateral shapes the area is the mean around each face. A face is at least
/// 1e-2 of its longest edge high.
/// @param uv (V, 2) the present map @param faces the faces to take
PatchShapes patch_shapes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                         const std::vector<Index>& faces, PatchShape shape);

}  // namespace koebe
