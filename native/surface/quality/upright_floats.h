// Rounds a plane map to 32-bit floats, in any frame, so that no face turns over.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// Reports count faces as the square of UVs stores them. Files of surfaces have another frame: the same map in
/// millimetres, turned. There other faces are as thin as the rounding.
/// @param points (V, 2) finite where a face has them @param triangles (F, 3)
/// @return (V, 2) 32-bit floats, each a few steps from its point at most: faces that are upright in 64 bits are upright
/// for every reader, as far as the neighbouring floats have room
KOEBE_API PlanarPoints upright_floats(const PlanarPoints& points, const Triangles& triangles);

}  // namespace koebe
