// Outlines drawn on a grid of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace koebe {

using GridPoint = std::array<std::int64_t, 2>;
using GridLoop = std::vector<GridPoint>;  ///< closed

constexpr std::int64_t grid_cell = 16;  ///< side of a cell, in grid units

/// Cells [from, to) of a row.
struct CellRun {
    int row = 0, from = 0, to = 0;
};

struct CellShape {
    int width = 0, height = 0;
    std::vector<CellRun> runs;  ///< by row, then by column
    GridPoint origin = {};      ///< lower left corner of the cells, in grid units

    std::int64_t cells() const;
};

/// All cells nearer than `reach` to the loops or to their inside. A point is inside if its winding number is not 0. The
/// first row and column of cells touch the drawing.
/// @param reach in grid units; along diagonals up to 8 % more
/// @param on_board the cells are those of a board with a corner at 0
CellShape cells_near(const std::vector<GridLoop>& loops, std::int64_t reach, bool on_board = false);

/// The shape turned by 180 degrees in its box of cells.
CellShape half_turn(const CellShape& shape);

}  // namespace koebe
