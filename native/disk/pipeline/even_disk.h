// Makes the map to the disk more even. It is no longer conformal, but one to one and in the unit disk.
#pragma once

#include "circles/circle_map.h"
#include "core/map_options.h"
#include "execution/execution.h"
#include "pipeline/map_input.h"

namespace koebe {

/// @throws InputError even is not from 0 to 1, or the surface names a centre, which could not stay at 0
void require_even_disk(double even, Index center);

/// Relaxes the map (even/even_map.h). Round loops stay on circles, and the outer one is brought back to the unit
/// circle. With free loops the map lies in the unit disk, and its circles are those that fit the loops best.
/// @param even above 0 @param map one to one, changed in place
/// @return whether the map was relaxed. If not, or if that would break a promise, the map is unchanged
bool make_disk_even(const MapInput& whole, double even, LoopForm loops, CircleMap& map, ExecutionContext& context);

}  // namespace koebe
