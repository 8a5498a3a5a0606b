// Draws parts in the unit square, or on tiles.
#pragma once

#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

/// Draws one path of triangles for each part, each in its own colour; v points up. Several tiles have their UDIM
/// numbers.
/// @param corner_uv (3F, 2) @param part (F), -1: not drawn @param tiles the number of tiles
std::string parts_svg(const PlanarPoints& corner_uv, const std::vector<Index>& part, int tiles = 1);

}  // namespace koebe
