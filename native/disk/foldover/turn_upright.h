// Turns a few faces upright in a map that is right elsewhere.
#pragma once

#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// Moves vertices up to 2, 6 and 18 rings round faces without positive area, by foldover-free minimization: first with
/// all loops held, then with the loops' vertices free, unless they are fixed, but so that no loops cross; at last
/// without this. untangle.h judges faces as they are stored in 32 bits. This function judges them in 64 bits: a needle
/// may be right as stored, and turned over by 1e-13.
/// @param vertices (V, 3) @param loops all boundary loops @param fixed (V) 1 for vertices that stay where they are
/// @param points (V, 2) changed only if all faces become upright
/// @return whether all faces are upright; loops may cross afterwards
bool turn_upright(const Vertices& vertices, const Triangles& triangles, const std::vector<VertexLoop>& loops,
                  const std::vector<char>& fixed, PlanarPoints& points, const ExecutionContext& context);

}  // namespace koebe
