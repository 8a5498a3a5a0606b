// Draws a tile and its copies.
#pragma once

#include "tiles/tile_map.h"

#include <string>

namespace koebe {

/// Draws the tile in the unit square's scale, and its copies by one period around it, paler.
std::string tile_svg(const TileResult& result);

}  // namespace koebe
