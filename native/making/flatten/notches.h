// Notches and numbers on the pieces of a pattern.
#pragma once

#include "flat/flat_part.h"
#include "flatten/pattern.h"
#include "flatten/seams.h"
#include "flatten/sheets.h"

#include <vector>

namespace koebe {

/// Notches at the same points of the surface on all sides of a seam, each inside its piece, and the number of the seam.
/// @param parts whose vertices (V, 3) are in units of `unit` mm
void mark_seams(const std::vector<Seam>& seams, const std::vector<FlatPart>& parts, PlacedPieces& placed);

/// The number of each piece, where it has room.
void number_pieces(const std::vector<FlatPart>& parts, PlacedPieces& placed);

}  // namespace koebe
