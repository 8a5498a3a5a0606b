// A map to a torus or a cylinder as UVs: one tile, cut in the UVs only. Its copies fill the plane or a strip.
#pragma once

#include "tiles/flat_map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace koebe {

/// UVs are whole multiples of 2^-24: in [0, 1] each is a 32-bit float, and so is its sum with a period. So the two
/// sides of a cut differ by periods to the last bit.
inline constexpr double uv_grid = 1.0 / 16777216.0;

using GridPoint = std::array<std::int64_t, 2>;

struct Tile {
    std::vector<GridPoint> corners;  ///< (3F) of the origins of the surface's half-edges, from 0 to 2^24
    std::vector<GridPoint> periods;
    double scale = 1.0;                    ///< of the map's plane in units of the UVs
    Complex origin{0.0, 0.0};              ///< of the map's plane, in UVs
    std::vector<std::array<int, 2>> lift;  ///< (3F) number of each period in a corner's position
    std::vector<Index> seams;              ///< half-edges whose other side lies elsewhere in the tile
};

/// Puts the map on the grid, cut as in cut_tile.
/// @param origin of its cell; by default chosen so that few holes are cut
Tile tile_of(const PeriodicSurface& domain, const FlatMap& map);
Tile tile_of(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin);

/// The holes in a tile: open, or slits along an axis.
enum class HoleShape { open, along_u, along_v };

/// The faults of a tile, computed from its grid points in whole numbers.
struct TileFaults {
    std::vector<Index> flipped;           ///< faces without positive area
    std::vector<Index> below_resolution;  ///< flipped faces whose longest edge is under uv_resolution
    std::vector<int> holes;               ///< loops that cross themselves, or run the wrong way
    bool seams = false;                   ///< the two sides of a cut do not differ by periods
    bool covering = false;                ///< the areas of faces and holes do not add up to the cell's

    bool any() const { return flipped.size() > below_resolution.size() || !holes.empty() || seams || covering; }
};

/// Checks that the tile covers the torus, or the cylinder between its rims, once. If all faces are upright, all holes
/// simple and a ring's rims apart and run through once in one direction, every point is covered equally often. The
/// areas add up to one cell, so it is covered once.
TileFaults find_faults(const PeriodicSurface& domain, const Tile& tile, HoleShape holes);

}  // namespace koebe
