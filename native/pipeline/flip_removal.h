// From the map of the core to one of the whole surface, without flips.
#pragma once

#include "circles/circle_map.h"
#include "execution/execution.h"
#include "flaps/flaps.h"
#include "foldover/untangle.h"
#include "pipeline/map_input.h"

namespace koebe {

/// Hangs the flaps back (hang_flaps), flips left as they are.
/// @param map of the core's vertices; of the surface's own if there are no flaps
CircleMap hang_back(const MapInput& whole, const FlapCut& cut, CircleMap map, ExecutionContext& context);

/// Turns flipped faces back (untangle); the surface's centre and point stay where they are. Circles between which no
/// place leaves them upright are made smaller. @param map of the whole surface, changed in place
UntangleReport remove_flips(const MapInput& whole, CircleMap& map, ExecutionContext& context);

}  // namespace koebe
