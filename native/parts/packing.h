// Packs islands into the unit square, or onto sheets in their own size.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// The area that an island covers: the inside of closed loops.
struct Outline {
    PlanarPoints points;
    std::vector<VertexLoop> loops;  ///< a loop that runs against the outer loop is a hole
    bool along_axes = false;        ///< the island lies along the axes already: it gets only quarter turns
};

/// The place of an island: a point z goes to offset + scale·turn·z.
struct IslandPlace {
    Complex turn = 1.0;
    Complex offset = 0.0;
};

struct Packing {
    std::vector<IslandPlace> places;
    double scale = 1.0;   ///< the same for all islands
    double margin = 0.0;  ///< the margin that was kept
};

/// Puts islands into the unit square, as large as it can. No island is mirrored. Each is turned so that its smallest
/// enclosing rectangle lies along the axes, unless it lies along them already. Outlines are drawn on a grid of cells,
/// with half the margin round them. Large islands are placed first, each in the lowest free place; small islands go
/// into hollows and holes. Several orders and rules are tried, more for few islands. All decisions are on integers, so
/// the result is the same on every system.
/// @param margin distance of two islands, and twice the distance from the border, in sides of the square. Many islands
/// get a smaller margin, so that they have room
/// @throws SolverError points that are NaN or infinite
Packing pack_islands(const std::vector<Outline>& outlines, double margin);

struct SheetSize {
    double width = 0.0, height = 0.0;
};

struct SheetPacking {
    std::vector<IslandPlace> places;
    std::vector<int> sheet;  ///< of each island; -1: no sheet is large enough, and it lies in a corner by itself
    int sheets = 0;
};

/// Puts islands onto sheets without a change of size, each in the lowest place of the first sheet that has room; drawn
/// on cells as above, the largest first.
/// @param margin between two islands, and half of it to the edge, in the unit of the points
/// @throws SolverError points that are NaN or infinite
SheetPacking pack_on_sheets(const std::vector<Outline>& outlines, double margin, const SheetSize& sheet);

/// The points (V, 2) of an island, moved to its place.
PlanarPoints place_island(const PlanarPoints& points, const IslandPlace& place, double scale);

}  // namespace koebe
