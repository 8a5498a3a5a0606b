// Packs islands into the unit square.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <functional>
#include <limits>
#include <vector>

namespace koebe {

/// The area that an island covers: the inside of closed loops.
struct Outline {
    PlanarPoints points;
    std::vector<VertexLoop> loops;  ///< a loop that runs against the outer loop is a hole
    bool along_axes = false;        ///< the island already lies along the axes
    bool alike = false;             ///< another island is like it, and should lie in the same turn
    Complex up = 0.0;               ///< direction that is better up than another, at equal use of the square; 0: any
};

/// The place of an island: a point z goes to offset + scale·turn·z.
struct IslandPlace {
    Complex turn = 1.0;
    Complex offset = 0.0;
};

struct IslandPacking {
    std::vector<IslandPlace> places;
    double scale = 1.0;   ///< the same for all islands
    double margin = 0.0;  ///< the margin that was kept
};

/// How long to look for a better packing.
struct PackingTime {
    std::function<bool()> is_over = {};  ///< ends the search with the best packing so far. Null: it never does
    bool is_used_up = false;             ///< true: the search goes on until then, for up to 999 islands
};

/// Islands on tiles, which are unit squares.
struct TilePacking : IslandPacking {
    std::vector<int> tile;  ///< of each island; its place is for tile 0
};

/// What lies on the tiles already.
struct PackingSite {
    std::vector<std::vector<Outline>> taken = {{}};               ///< of each tile, places as seen from its corner
    double most_scale = std::numeric_limits<double>::infinity();  ///< of the islands
};

/// Puts islands into the unit square, as large as it can. No island is mirrored. Each island is turned so that its
/// smallest enclosing rectangle lies along the axes, unless the island already lies along them. Of the quarter turns
/// the one with `up` nearest to up is taken where it costs no room. Islands
/// that are alike lie in one turn where that makes all islands smaller by at most 2 %. Other turns are used only
/// where they make all islands larger by 2.5 %. Islands that lie along the axes already keep to quarter turns. Outlines
/// are drawn on a grid of cells, with half the margin round them. Large islands are placed first, each in the lowest
/// free place; small islands go into hollows and holes. Several orders and rules are tried. Up to 100 islands are then
/// moved closer together (tight_packing.h). From 1,000 islands on, their boxes are put on shelves where that is about
/// as good (shelf_packing.h). All decisions are on integers, so the result is the same on every system.
/// @param margin distance of two islands, and twice the distance from the border, in sides of the square. It is made
/// smaller for many islands, so that they have room
/// @throws SolverError points that are NaN or infinite
IslandPacking pack_islands(const std::vector<Outline>& outlines, double margin, const PackingTime& time = {});

/// Puts islands into the free places of the tiles, as above, each onto the first tile with room. None is moved closer
/// to others in the end.
/// @throws InputError there is no room for them; SolverError
TilePacking pack_around(const std::vector<Outline>& outlines, double margin, const PackingSite& site,
                        const PackingTime& time = {});

/// The points (V, 2) of an island, moved to its place.
PlanarPoints place_island(const PlanarPoints& points, const IslandPlace& place, double scale);

}  // namespace koebe
