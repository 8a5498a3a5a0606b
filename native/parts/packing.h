// Islands into the unit square, or onto sheets in their own size.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// What an island covers: the inside of closed loops.
struct Outline {
    PlanarPoints points;
    std::vector<VertexLoop> loops;  ///< an inner loop that runs against the outer one is a hole
    bool along_axes = false;        ///< it lies along the axes already: quarter turns alone
};

/// Where points go: offset + scale·turn·z.
struct IslandPlace {
    Complex turn = 1.0;
    Complex offset = 0.0;
};

struct Packing {
    std::vector<IslandPlace> places;
    double scale = 1.0;   ///< of all islands
    double margin = 0.0;  ///< as it was kept
};

/// Puts islands into the unit square, as large as it finds room for. None is mirrored. Each lies with its smallest
/// enclosing rectangle along the axes, or as it lay along them. Outlines are drawn on a grid of cells, with half the
/// margin round them, and the largest are placed first, each in the lowest place where its cells are free; smaller ones
/// go into hollows and holes. Several orders and rules are tried, more where islands are few. All decisions are on
/// integers: the result is the same on every system.
/// @param margin between two islands, and half of it to the border, in units of the square; of many islands less, such
/// that they have room
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

/// Points (V, 2) of an island where it is placed.
PlanarPoints place_island(const PlanarPoints& points, const IslandPlace& place, double scale);

}  // namespace koebe
