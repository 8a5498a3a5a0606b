// Cuts closed surfaces in two. This replaces the slit that opens them.
#pragma once

#include "cut/open_surface.h"
#include "part_maps/part_mesh.h"

#include <optional>
#include <vector>

namespace koebe {

/// Closes a piece that was opened only by a slit. Vertices keep the piece's numbers. Of two vertices that the slit made
/// out of one, one number stays.
/// @param vertices (V') of the piece @return nothing if the piece has another boundary, or handles
std::optional<CutSurface> closed_surface(const SurfacePiece& piece, const Vertices& vertices,
                                         const std::vector<Index>& polygon);

/// Whether a surface has so short a boundary that a map from it says as little as one from a slit; closed ones, too.
bool is_nearly_closed(const CutSurface& whole);

/// Whether a surface has a boundary that is cuts alone.
bool is_between_cuts(const CutSurface& whole);

/// The two pieces of a surface that is closed, or nearly (halving.h). @return the faces of each piece, ascending; empty
/// if no curve was found
std::vector<std::vector<Index>> halves(const CutSurface& whole);

}  // namespace koebe
