// Pockets of a surface: hidden regions behind a narrow rim.
#pragma once

#include "part_maps/part_mesh.h"

#include <array>
#include <vector>

namespace koebe {

/// The rims of pockets, such as the mouth and the sockets of the eyes of a head. A person cuts there, where nobody sees
/// it. A pocket that stays bends the rest, and the cuts that help go over the face.
/// @return edges, as pairs of vertices of the whole; empty: there is no pocket
std::vector<std::array<Index, 2>> pocket_rims(const CutSurface& whole);

}  // namespace koebe
