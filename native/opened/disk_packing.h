// Disks side by side in a square.
#pragma once

#include "circles/circle.h"

#include <vector>

namespace koebe {

/// Disks of the given relative sizes, scaled and placed in the square [-1, 1]^2, apart from each other: in rows, the
/// largest first, of the width that leaves the least of the square empty. One disk fills the square.
/// @param radii positive, any unit
std::vector<Circle> pack_disks(const std::vector<double>& radii);

}  // namespace koebe
