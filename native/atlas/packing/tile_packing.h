// Packs islands onto several unit squares, as UDIM tiles.
#pragma once

#include "packing/packing.h"

#include <vector>

namespace koebe {

constexpr int tiles_in_row = 10;  ///< tile k is the square at u = k mod 10, v = k / 10: UDIM 1001 + k
constexpr int most_tiles = 100;   ///< v up to 10, too

/// The lower left corner of a tile.
inline Eigen::RowVector2d tile_corner(int tile) { return Eigen::RowVector2d(tile % tiles_in_row, tile / tiles_in_row); }

/// Puts islands onto tiles, at one scale, as large as it can. First they are spread at the largest scale at which the
/// tiles have room for them, one after the other, the largest first (sheet_packing.h). Then each tile is packed by
/// itself (pack_islands), and small islands move from the fullest tile to the emptiest one. With one tile this is
/// pack_islands.
/// @param margin as in pack_islands @param time on several tiles it ends the search, and is not used up @throws
/// SolverError points that are NaN or infinite
TilePacking pack_on_tiles(const std::vector<Outline>& outlines, double margin, int tiles, const PackingTime& time = {});

/// The number of tiles on which islands have room at this scale, one after the other; most_tiles if they have none.
int tiles_for(const std::vector<Outline>& outlines, double margin, double scale);

/// The same packing, smaller. @param factor at most 1
TilePacking shrunk(TilePacking packing, double factor);

}  // namespace koebe
