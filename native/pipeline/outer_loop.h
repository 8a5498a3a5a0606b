// Which loop goes onto the unit circle, chosen once there is a map to judge by.
#pragma once

#include "balance/area_balance.h"
#include "circles/circle_map.h"
#include "pipeline/map_input.h"

#include <optional>

namespace koebe {

/// The loop that, put on the unit circle by w = r / (z - c) and balanced, leaves the least area distortion.
/// @param circles of all loops, the outer one, the unit circle, first
/// @param candidates ranks in circles to choose from, 0 among them; another one must beat it by a fifth
int balanced_outer_loop(const FaceScales& scales, const std::vector<Circle>& circles,
                        const std::vector<int>& candidates);

/// The loop that, on the unit circle and balanced, leaves the least area distortion (balanced_outer_loop): one of the
/// eight longest, 0 unless another is better by a fifth.
int better_outer_loop(const MapInput& input, const CircleMap& map);

/// Puts a loop first in the lists of loops, and the others after it in the order they have.
/// @param loop its place in them @param core the surface without flaps, if there are flaps
void put_outside(int loop, MapInput& whole, FlapCut& cut, std::optional<MapInput>& core);

}  // namespace koebe
