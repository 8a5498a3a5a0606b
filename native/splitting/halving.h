// A part cut in two across its length.
#pragma once

#include "evenness/part_mesh.h"

#include <vector>

namespace koebe {

/// The shortest curve between the 35 % and the 65 % of the area that are nearest the two ends of the part, which are
/// vertices far apart. It asks no map, so it helps where a map says nothing.
/// @return (F) 1 on one side, 0 on the other; empty if no curve was found, as polygons may stand in the way
std::vector<int> halving(const PartMesh& part);

}  // namespace koebe
