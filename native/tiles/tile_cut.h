// Where a map to a torus or a cylinder is cut to be one tile: how many periods are added to each corner.
#pragma once

#include "tiles/flat_map.h"

#include <array>
#include <vector>

namespace koebe {

/// How many of each period.
using Lift = std::array<int, 2>;

/// A point in periods; of a cylinder along its only one, the other coordinate 0.
std::array<double, 2> in_periods(const FlatMap& map, Complex z);

Complex lifted(const FlatMap& map, Complex z, Lift lift);

/// The origin of a cell, in periods, that among some cuts the fewest holes.
std::array<double, 2> clear_origin(const PeriodicSurface& domain, const FlatMap& map);

/// Every face, or polygon of faces, goes where its middle lies in the cell, the parallelogram of the periods; what
/// hangs on the others by no edge goes to its neighbours, so that the tile is one piece.
/// @return (3F) of the corners
std::vector<Lift> cut_tile(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin);

/// Whether the other side of a half-edge lies elsewhere.
bool is_seam(const PeriodicSurface& domain, const std::vector<Lift>& lift, Index h);

}  // namespace koebe
