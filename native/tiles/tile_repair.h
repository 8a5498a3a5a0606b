// Flipped faces of a map to a torus or a cylinder, turned back.
#pragma once

#include "execution/execution.h"
#include "tiles/tile.h"

#include <cstddef>

namespace koebe {

/// Turns flipped faces back in their neighbourhoods (untangle), in tiles cut elsewhere.
/// Vertices of slits stay; those of holes slide along their circles, if they have some, or leave their places.
/// @return how many faces are flipped still
std::size_t turn_faces_back(const PeriodicSurface& domain, HoleShape shape, FlatMap& map, ExecutionContext& context);

}  // namespace koebe
