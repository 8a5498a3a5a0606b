// A map to a torus or a cylinder as UVs: one tile, cut in the UVs alone, whose copies fill the plane or a strip.
#pragma once

#include "tiles/flat_map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace koebe {

/// UVs as whole multiples of 2^-24: in [0, 1] each is a 32-bit float, and so is the sum of one and a period. So the
/// two sides of a cut differ by periods to the last bit.
inline constexpr double uv_grid = 1.0 / 16777216.0;

using GridPoint = std::array<std::int64_t, 2>;

struct Tile {
    std::vector<GridPoint> corners;  ///< (3F) of the surface's half-edges' origins, from 0 to 2^24
    std::vector<GridPoint> periods;
    double scale = 1.0;                    ///< of the plane of the map in units of the UVs
    Complex origin{0.0, 0.0};              ///< of the plane, in UVs
    std::vector<std::array<int, 2>> lift;  ///< (3F) how many of each period are in a corner's position
    std::vector<Index> seams;              ///< half-edges whose other side lies elsewhere
};

/// The map on the grid, cut as cut_tile has it.
/// @param origin of its cell; it is chosen so that few holes are cut
Tile tile_of(const PeriodicSurface& domain, const FlatMap& map);
Tile tile_of(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin);

/// What holes are in a tile: open, or slits along one of the axes.
enum class HoleShape { open, along_u, along_v };

/// What a tile promises, read from its grid points in whole numbers.
struct TileFaults {
    std::vector<Index> flipped;           ///< faces whose area is not positive
    std::vector<Index> below_resolution;  ///< those of them whose longest edge is under uv_resolution
    std::vector<int> holes;               ///< loops that cross themselves, or run the wrong way round
    bool seams = false;                   ///< the sides of a cut do not differ by periods
    bool covering = false;                ///< the areas of faces and holes do not sum up to that of the cell

    bool any() const { return flipped.size() > below_resolution.size() || !holes.empty() || seams || covering; }
};

/// Where all faces are upright, all holes simple, and the rims of a ring apart and run through one way and once, the
/// map covers each point of the torus, or of the cylinder between its rims, equally often: by the sum of the areas,
/// once.
TileFaults find_faults(const PeriodicSurface& domain, const Tile& tile, HoleShape holes);

}  // namespace koebe
