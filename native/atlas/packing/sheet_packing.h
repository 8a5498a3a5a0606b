// Packs islands onto sheets, in their own size.
#pragma once

#include "packing/packing.h"

#include <vector>

namespace koebe {

struct SheetSize {
    double width = 0.0, height = 0.0;
};

struct SheetPacking {
    std::vector<IslandPlace> places;
    std::vector<int> sheet;  ///< of each island; -1: no sheet is large enough, and it lies in a corner by itself
    int sheets = 0;
};

/// Puts islands onto sheets without a change of size, the largest first. Each island gets the lowest place of the first
/// sheet that has room. Islands are drawn on cells as in packing.h.
/// @param margin between two islands, and half of it to the edge, in the unit of the points
/// @throws SolverError points that are NaN or infinite
SheetPacking pack_on_sheets(const std::vector<Outline>& outlines, double margin, const SheetSize& sheet);

}  // namespace koebe
