// The shapes and sizes that faces have in a map that is true to size.
#pragma once

#include "core/types.h"
#include "foldover/patch_shapes.h"

namespace koebe {

/// Of all faces, each in its own shape (foldover/patch_shapes.h).
/// @param sizes (F) factor of each face's area; empty: 1 for all faces
PatchShapes wanted_shapes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                          const VectorXd& sizes);

}  // namespace koebe
