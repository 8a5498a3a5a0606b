// A sheet that goes on over holes and beyond rims, so that outlines that meet them can be followed.
#pragma once

#include "lift/flat_sheet.h"

namespace koebe {

/// The sheet's faces come first, unchanged. Further faces fill holes, and lie around the outer loop of a disk, or
/// beyond the rims of a ring, as far as the domain is large. `gap` numbers the hole or rim of each of these faces, and
/// is -1 for the surface's own. A loop that cannot be filled stays a border: a slit without area in the UVs, a loop
/// that a cut divides, the outer loop of one of several parts.
FlatSheet filled_sheet(const FlatSheet& sheet);

}  // namespace koebe
