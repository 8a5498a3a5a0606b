// A surface with handles cut along circles of a map that it has already, through its faces.
#pragma once

#include "schottky/schottky_tile.h"

#include <optional>

namespace koebe {

/// The same surface cut again, where the fundamental circles of a map lie on it. A path along edges has corners, at
/// which the flux through it is known to first order at best; along a circle it is smooth.
/// @param cut along edges or otherwise @param faces that were cut @param plane its map @param circles apart
/// @return nothing where a face meets two circles, or one of them a hole: the mesh is too coarse for them
std::optional<HandleCut> cut_along_circles(const HandleCut& cut, const FinerFaces& faces, const SchottkyPlane& plane,
                                           const FundamentalCircles& circles);

}  // namespace koebe
