// Divided faces in flat parts: their edges are laid straight, so that the faces may become whole again.
#pragma once

#include "cut/open_surface.h"
#include "flat/divided_faces.h"
#include "flat/flat_part.h"

#include <array>
#include <vector>

namespace koebe {

/// Moves the vertices that divide edges onto the straight lines between the edges' ends.
/// @param left_out of the pieces @param parts of the pieces
/// @return edges, as pairs of vertices, that must not be divided: of faces whose pieces are in several parts, or left
/// out, and edges whose vertices cannot move there, as a face would turn over, or the outline of a part cross itself
std::vector<std::array<Index, 2>>
lay_middles_straight(const DividedFaces& faces, const std::vector<LeftOutFace>& left_out, std::vector<FlatPart>& parts);

}  // namespace koebe
