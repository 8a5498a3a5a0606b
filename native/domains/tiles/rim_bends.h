// Bends the straight rims of a ring where a face would have no area.
#pragma once

#include "tiles/flat_map.h"

namespace koebe {

/// An ear on a straight rim would have no area. There the rim runs along a parabola, inward at
/// the ends of the edge: as deep as an arc of the disk would be, and deeper where 32-bit UVs need it.
/// @param places of the boundary, with straight rims; changed
void bend_rims(const PeriodicSurface& domain, VectorXcd& places, FlatMap& map);

}  // namespace koebe
