// Turns flipped faces of a map to a torus or a cylinder back.
#pragma once

#include "execution/execution.h"
#include "tiles/tile.h"

#include <cstddef>

namespace koebe {

/// Turns flipped faces back in their neighbourhoods (untangle), in tiles with different cuts. Vertices of slits stay.
/// Vertices of other holes slide along their circles, if any, or leave their places.
/// @return the number of faces that are still flipped
std::size_t turn_faces_back(const PeriodicSurface& domain, HoleShape shape, FlatMap& map, ExecutionContext& context);

}  // namespace koebe
