// A periodic map made more even, its periods too.
#pragma once

#include "core/map_options.h"
#include "execution/execution.h"
#include "surface/periodic_surface.h"
#include "tiles/flat_map.h"

namespace koebe {

/// Relaxes the map and its periods (relax/even_map.h). The rims of a ring stay straight. Round holes lie on circles of
/// the plane, free ones have none; a vertex that cannot be brought to its circle is off it.
/// @param even above 0 @param map changed in place @return whether it was relaxed: if not, it is as it was
bool make_tile_even(const PeriodicSurface& domain, double even, LoopForm loops, FlatMap& map,
                    ExecutionContext& context);

}  // namespace koebe
