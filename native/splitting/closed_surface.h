// Closed surfaces, cut in two in place of the slit that opens them.
#pragma once

#include "cut/open_surface.h"
#include "evenness/part_mesh.h"

#include <optional>
#include <vector>

namespace koebe {

/// A piece that was opened by a slit alone, closed again. Vertices are the piece's, those that the slit has doubled
/// under one of their numbers.
/// @param vertices (V') of the piece @return none if it has another boundary, or handles
std::optional<CutSurface> closed_surface(const SurfacePiece& piece, const Vertices& vertices,
                                         const std::vector<Index>& polygon);

/// The pieces that halving (halving.h) cuts it into. @return faces of each, rising; none if no curve was found
std::vector<std::vector<Index>> halves(const CutSurface& closed);

}  // namespace koebe
