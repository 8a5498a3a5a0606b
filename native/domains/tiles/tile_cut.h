// Cuts a map to a torus or a cylinder to one tile: adds periods to each corner.
#pragma once

#include "tiles/flat_map.h"

#include <array>
#include <vector>

namespace koebe {

/// Number of each period to add.
using Lift = std::array<int, 2>;

/// The point in units of the periods. On a cylinder only the first coordinate counts, the other is 0.
std::array<double, 2> in_periods(const FlatMap& map, Complex z);

Complex lifted(const FlatMap& map, Complex z, Lift lift);

/// The origin of a cell, in periods, that among some origins cuts the fewest holes.
std::array<double, 2> clear_origin(const PeriodicSurface& domain, const FlatMap& map);

/// Puts every face, or polygon of faces, where its middle lies in the cell, the parallelogram of the periods. A part
/// that shares no edge with the others moves to its neighbours, so that the tile is one piece.
/// @return (3F) lifts of the corners
std::vector<Lift> cut_tile(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin);

/// Whether the other side of a half-edge lies elsewhere in the tile.
bool is_seam(const PeriodicSurface& domain, const std::vector<Lift>& lift, Index h);

}  // namespace koebe
