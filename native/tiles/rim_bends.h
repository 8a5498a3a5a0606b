// Straight rims of a ring, bent where a face would have no area.
#pragma once

#include "tiles/flat_map.h"

namespace koebe {

/// What hangs on a straight rim by one edge would have no area. So the rim runs along a parabola there, inward at the
/// ends of the edge: as deep as the arc of the disk would be, and deeper where 32-bit UVs need it.
/// @param places of the boundary, the rims straight; changed
void bend_rims(const PeriodicSurface& domain, VectorXcd& places, FlatMap& map);

}  // namespace koebe
