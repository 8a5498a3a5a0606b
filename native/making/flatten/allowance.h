// The seam allowance of a flat piece: its outline, moved outwards.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// The boundary of all points that are at most `width` away from the piece, as closed rings: counter-clockwise round
/// the piece, clockwise round holes that stay open. Darts that are narrower than twice the width are covered. Rings
/// keep the width to one and a half per cent; round corners are drawn to a fiftieth of a unit, inside the arc.
/// @param loops boundary loops, simple and apart @param points (V, 2) @param width above 0, in the unit of the points
/// @return none if no rings were found that keep the width and do not cross
std::vector<PlanarPoints> allowance_rings(const std::vector<VertexLoop>& loops, const PlanarPoints& points,
                                          double width);

}  // namespace koebe
