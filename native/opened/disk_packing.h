// Disks side by side in a square.
#pragma once

#include "circles/circle.h"
#include "core/api.h"

#include <vector>

namespace koebe {

/// Disks of the given relative sizes, as large as they are found to fit the square [0, 1]^2: up to 16 are nested, each
/// in the lowest place where it touches two other things; more lie in rows, the largest first. The size is found by
/// bisection. One disk fills the square.
/// @param radii positive, any unit
/// @param margin between two disks, and half of it to the border, in units of the square; of many disks less, such that
/// they have room
KOEBE_API std::vector<Circle> pack_disks(const std::vector<double>& radii, double margin = 0.02);

}  // namespace koebe
