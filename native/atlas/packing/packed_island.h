// An island to pack: turned upright, and drawn on a grid of cells in its four quarter turns.
#pragma once

#include "packing/cell_board.h"
#include "packing/packing.h"

#include <array>
#include <cstdint>
#include <vector>

namespace koebe {

struct UprightIsland {
    PlanarPoints points;  ///< turned upright, with the lower left corner of their box at 0
    const std::vector<VertexLoop>* loops;
    Complex turn, up = 0.0;     ///< as in Outline, turned
    Eigen::RowVector2d corner;  ///< of the box, before it was moved to 0
    double area = 0.0, extent = 0.0;
};

UprightIsland upright_island(const Outline& outline);

/// The island turned further. @param turn of absolute value 1
UprightIsland turned_island(const UprightIsland& island, const Complex& turn);

/// How much each quarter turn is to be preferred: by up in the world, or the turn in which the island is upright.
std::array<double, 4> upright_by_turn(const UprightIsland& island);

/// The island in the quarter turn that is preferred.
UprightIsland most_upright(const UprightIsland& island);

/// An island in one of its turns.
struct DrawnTurn {
    CellShape shape;
    std::vector<CellRun> order;  ///< of tests
};

using DrawnTurns = std::array<DrawnTurn, 4>;

/// @param scale grid units of a unit of the points @param reach of the margin, in grid units
DrawnTurns draw_island(const UprightIsland& island, double scale, std::int64_t reach);

/// An island that keeps its place, with half the margin round it: the cells of a board of the unit square that it
/// takes.
/// @param side cells of the board
CellShape cells_on_board(const Outline& outline, int side, double margin);

/// All islands at one scale, each with half the margin round it. @param unit grid units of the square's side
std::vector<DrawnTurns> draw_islands(const std::vector<UprightIsland>& islands, double scale, double unit,
                                     double margin);

/// The largest scale at which islands can have room in so many squares: each takes at least its area, half the margin
/// along its extent on both sides, and a disk of the margin's width.
double largest_scale(const std::vector<UprightIsland>& islands, double margin, std::size_t tiles = 1);

/// A place on a board, in cells.
struct CellSpot {
    int turn = 0, x = 0, y = 0;
    std::size_t tile = 0;
};

/// @param unit grid units of the square's side @param scale of the island, in sides of the square
IslandPlace place_of_spot(const UprightIsland& island, const DrawnTurns& turns, const CellSpot& spot, double unit,
                          double scale);

/// Number of cells along a side of the board, for so many islands.
int board_side(std::size_t count);

/// Of so many islands each begins to look for room at the row of the one before it, which has about its size: lower
/// rows are full.
constexpr std::size_t many_islands = 200;

/// The largest margin that so many islands keep, in sides of the square.
double most_margin(std::size_t count);

/// @throws SolverError a point is NaN or infinite
void require_finite_outlines(const std::vector<Outline>& outlines);

}  // namespace koebe
