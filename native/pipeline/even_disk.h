// The map to the disk made more even: no longer conformal, still one to one, in the unit disk.
#pragma once

#include "circles/circle_map.h"
#include "core/map_options.h"
#include "execution/execution.h"
#include "pipeline/map_input.h"

namespace koebe {

/// @throws InputError even is not from 0 to 1, or the surface names a centre, which would not stay at 0
void require_even_disk(double even, Index center);

/// Relaxes the map (relax/even_map.h). Round loops: each stays on a circle, that of the outer one brought back to the
/// unit circle. Free ones: the map lies in the unit disk, its circles are those that fit the loops best.
/// @param even above 0 @param map one to one, changed in place
/// @return whether it was relaxed: if not, or if it would break a promise, it is as it was
bool make_disk_even(const MapInput& whole, double even, LoopForm loops, CircleMap& map, ExecutionContext& context);

}  // namespace koebe
