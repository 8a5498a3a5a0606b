// Extends the map of the core to the whole surface, and removes flips.
#pragma once

#include "circles/circle_map.h"
#include "ears/ears.h"
#include "execution/execution.h"
#include "foldover/untangle.h"
#include "pipeline/map_input.h"

namespace koebe {

/// Adds the ears to the map of the core (lay_ears). Leaves flips as they are.
/// @param map of the core's vertices; without ears, of the surface's own vertices
CircleMap with_ears(const MapInput& whole, const EarCut& cut, CircleMap map, ExecutionContext& context);

/// Turns flipped faces back (untangle). The surface's centre and point do not move. Circles shrink where the faces
/// between them find no place to be upright, and then the search starts again with its full effort. If up to 16 faces
/// stay flipped, the search starts anew from the first map, with the circles at these faces smaller: tiny changes of
/// the start decide whether a crowded place is untangled. Up to four starts; if all fail, the first one counts.
/// @param map of the whole surface, changed in place
UntangleReport remove_flips(const MapInput& whole, CircleMap& map, ExecutionContext& context);

}  // namespace koebe
