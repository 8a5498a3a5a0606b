// Makes a periodic map and its periods more even.
#pragma once

#include "execution/execution.h"
#include "surface/periodic_surface.h"
#include "tiles/flat_map.h"
#include "tiles/tile_map.h"

namespace koebe {

/// Relaxes the map and its periods (even/even_map.h). The rims of a ring stay straight. Round holes lie on circles of
/// the plane, free holes have no circles. A vertex that cannot be brought to its circle counts as off it.
/// @param options even above 0; importance by the vertices of the input
/// @param map changed in place @return whether it was relaxed; if not, the map is unchanged
bool make_tile_even(const PeriodicSurface& domain, const TileOptions& options, FlatMap& map, ExecutionContext& context);

}  // namespace koebe
