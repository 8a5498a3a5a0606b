// Maps a ring to a strip with slits as holes.
#pragma once

#include "tiles/flat_map.h"
#include "tiles/tile_map.h"

namespace koebe {

/// Makes the rims straight and the holes slits: u and v are the two harmonic functions.
/// @param holes concentric or radial @param height out: height over period
FlatMap slit_map(const PeriodicSurface& domain, RingHoles holes, double& height);

}  // namespace koebe
