// Places pieces on sheets, and makes the drawing of each sheet.
#pragma once

#include "flatten/pattern.h"
#include "flatten/seams.h"
#include "packing/sheet_packing.h"

#include <vector>

namespace koebe {

/// A piece before it has its place.
struct PieceShape {
    PlanarPoints points;  ///< (V, 2) mm
    std::vector<VertexLoop> loops;
    std::vector<PlanarPoints> allowance;  ///< rings; empty: none
};

struct PlacedPieces {
    std::vector<PlanarPoints> points;  ///< (V, 2) on the sheet
    std::vector<int> sheet;
    Pattern pattern;  ///< with the outlines and allowances
};

/// @param allowance mm @throws InputError more pages than anybody prints
PlacedPieces place_pieces(const std::vector<PieceShape>& pieces, double allowance, const Page& page);

}  // namespace koebe
