// Pinholes of scans, filled while parts are decided and relaxed: so their rims need no room and cannot cross.
#pragma once

#include "flat/flat_part.h"
#include "splitting/piece_surface.h"

#include <optional>
#include <vector>

namespace koebe {

/// The piece with its pinholes filled by fans round new vertices. The new vertices and faces come last, and the faces
/// have no source (-1). Stays open: the longest loop, a loop at a cut, and a hole whose fan would be too thin.
/// @param surface of the piece @return nothing if there is no pinhole
std::optional<PieceInput> without_pinholes(const PieceInput& input, const Surface& surface);

/// A part without the faces that fill pinholes, in its place; in several pieces if only these faces joined them.
/// @param faces how many faces the surface has that fill nothing
std::vector<FlatPart> with_pinholes(FlatPart part, Index faces);

}  // namespace koebe
