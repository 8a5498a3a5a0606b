// Cuts a surface with handles along circles of a map that it already has, through its faces.
#pragma once

#include "schottky/schottky_tile.h"

#include <optional>

namespace koebe {

/// Cuts the same surface again, along the fundamental circles of a map. A path along edges has corners, where the flux
/// through it is known to first order at best; a circle is smooth.
/// @param cut along edges or otherwise @param faces that were cut @param plane its map @param circles apart
/// @return nothing where a face meets two circles, or a circle and a hole: the mesh is too coarse for them
std::optional<HandleCut> cut_along_circles(const HandleCut& cut, const FinerFaces& faces, const SchottkyPlane& plane,
                                           const FundamentalCircles& circles);

}  // namespace koebe
