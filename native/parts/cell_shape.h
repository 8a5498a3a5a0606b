// Outlines drawn on a grid of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace koebe {

using GridPoint = std::array<std::int64_t, 2>;
using GridLoop = std::vector<GridPoint>;  ///< closed

constexpr std::int64_t grid_cell = 16;  ///< grid units a side

/// Cells [from, to) of a row.
struct CellRun {
    int row = 0, from = 0, to = 0;
};

struct CellShape {
    int width = 0, height = 0;
    std::vector<CellRun> runs;  ///< by row, then by column
    GridPoint origin = {};      ///< of the cells, in grid units

    std::int64_t cells() const;
};

/// All cells that come nearer than `reach` to the inside of the loops or to the loops themselves. A point is inside if
/// the winding number is not 0. Cells lie tight round the drawing at its left and lower side.
/// @param reach in grid units; diagonally up to 8 % more is kept
CellShape cells_near(const std::vector<GridLoop>& loops, std::int64_t reach);

/// The shape turned by 180 degrees in its box of cells.
CellShape half_turn(const CellShape& shape);

}  // namespace koebe
