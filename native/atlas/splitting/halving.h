// A part cut in two across its length.
#pragma once

#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

/// Takes two vertices far apart as the ends. Cuts along the shortest curve that leaves at least 35 % of the area on
/// each side, where faces are ordered from end to end. Needs no map, so it helps where the map is useless.
/// @return (F) 1 on one side, 0 on the other; empty if no curve was found: polygons can be in the way
std::vector<int> halving(const PartMesh& part);

}  // namespace koebe
