// A ring whose holes are slits.
#pragma once

#include "tiles/flat_map.h"
#include "tiles/tile_map.h"

namespace koebe {

/// Rims straight, holes slits: u and v of the two harmonic functions.
/// @param holes not circles @param height set: over the period
FlatMap slit_map(const PeriodicSurface& domain, RingHoles holes, double& height);

}  // namespace koebe
