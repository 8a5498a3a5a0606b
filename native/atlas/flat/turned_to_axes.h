// Turns flat parts so that their straight edges lie along the axes, and finds where up in the world is in them.
#pragma once

#include "flat/flat_part.h"

#include <vector>

namespace koebe {

/// Turns parts with long edges that are straight in space and in the plane: the direction in which most of their length
/// runs, up to quarter turns, lies along an axis to rounding, and `along_axes` is set. Other parts stay as they are.
/// Sets `up` of all parts.
/// @param up upwards in space, a direction of length 1
void turn_to_axes(std::vector<FlatPart>& parts, const Eigen::RowVector3d& up);

}  // namespace koebe
