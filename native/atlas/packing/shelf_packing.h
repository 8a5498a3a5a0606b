// Packs thousands of islands: in their boxes on shelves, or by first fit on a board.
#pragma once

#include "packing/packing.h"

#include <vector>

namespace koebe {

/// Puts the islands' boxes side by side on shelves, the highest first: next fit by decreasing height [Coffman, Garey,
/// Johnson and Tarjan 1980]. Where that fills the square clearly less than it could be filled, islands are drawn on a
/// board and placed by falling area, each in the lowest place that comes after those where a similar island found no
/// room.
/// @param margin as pack_islands keeps it @throws SolverError the islands have no room
IslandPacking pack_on_shelves(const std::vector<Outline>& outlines, double margin);

}  // namespace koebe
