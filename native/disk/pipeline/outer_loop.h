// Chooses the loop for the unit circle, once there is a map to judge by.
#pragma once

#include "balance/area_balance.h"
#include "circles/circle_map.h"
#include "pipeline/map_input.h"

#include <optional>

namespace koebe {

/// The loop with the least area distortion after w = r / (z - c) has put it on the unit circle and the map is balanced.
/// @param circles of all loops; the first is the outer one, the unit circle
/// @param candidates ranks in circles to choose from, 0 among them; another loop must beat loop 0 by a fifth
int balanced_outer_loop(const FaceScales& scales, const std::vector<Circle>& circles,
                        const std::vector<int>& candidates);

/// The loop with the least area distortion on the unit circle (balanced_outer_loop), among the eight longest. Another
/// loop must beat loop 0 by a fifth.
int better_outer_loop(const MapInput& input, const CircleMap& map);

/// Puts a loop first in the lists of loops. The others follow in their present order.
/// @param loop its place in them @param core the surface without ears, if there are ears
void put_outside(int loop, MapInput& whole, EarCut& cut, std::optional<MapInput>& core);

}  // namespace koebe
