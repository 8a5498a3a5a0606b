#include "packing/packed_island.h"

#include "core/errors.h"
#include "packing/bit_row.h"
#include "planar/convex_hull.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr int least_side = 1024;           // cells along the square,
constexpr double cells_an_island = 32.0;   // and at least this times the root of the number of islands
constexpr double worth_a_turn = 0.999;     // of the area of the box: a turn must make it smaller than this
constexpr double share_of_margins = 0.25;  // most margin, over an island's side if all were equal squares
constexpr std::size_t most_sides = 1000;   // sides of the hull along which boxes are tried

constexpr std::array<Complex, 4> quarters = {Complex(1, 0), Complex(0, 1), Complex(-1, 0), Complex(0, -1)};

double across(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

PlanarPoints turned_by(const PlanarPoints& points, const Complex& turn)
{
    PlanarPoints at(points.rows(), 2);
    at.col(0) = turn.real() * points.col(0) - turn.imag() * points.col(1);
    at.col(1) = turn.imag() * points.col(0) + turn.real() * points.col(1);
    return at;
}

/// The turn that lays the smallest rectangle round the points along the axes, its long side upright.
Complex upright_turn(const Outline& outline)
{
    const PlanarPoints corners = outline.points(convex_hull(outline.points), Eigen::all);
    const auto count = outline.along_axes ? 0 : static_cast<std::size_t>(corners.rows());
    Complex best = 1.0;
    Eigen::RowVector2d size = box_size(corners);
    for (std::size_t i = 0; i < count; i += count / most_sides + 1) {
        const Eigen::RowVector2d side = corners.row((i + 1) % count) - corners.row(i);
        const double length = side.norm();
        if (!(length > 0.0)) continue;
        const Complex turn(side[0] / length, -side[1] / length);
        const Eigen::RowVector2d own = box_size(turned_by(corners, turn));
        if (!(own.prod() < worth_a_turn * size.prod())) continue;
        best = turn;
        size = own;
    }
    return size[0] > size[1] ? best * quarters[1] : best;
}

/// The part of a closed line near the unit square: clipped at the sides of a square three times as large [Sutherland
/// and Hodgman 1974]. Its winding numbers in the unit square stay.
std::vector<Eigen::RowVector2d> clipped(const PlanarPoints& loop)
{
    std::vector<Eigen::RowVector2d> points;
    for (const auto& point : loop.rowwise()) points.emplace_back(point);
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double sign = side % 2 == 0 ? 1.0 : -1.0, most = side % 2 == 0 ? 2.0 : 1.0;  // sign x <= most
        std::vector<Eigen::RowVector2d> kept;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::RowVector2d &a = points[i], &b = points[(i + 1) % points.size()];
            const double over_a = sign * a[axis] - most, over_b = sign * b[axis] - most;
            if (over_a <= 0.0) kept.push_back(a);
            if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
                Eigen::RowVector2d cut = a + over_a / (over_a - over_b) * (b - a);
                cut[axis] = sign * most;
                kept.push_back(cut);
            }
        }
        points = std::move(kept);
    }
    return points;
}

/// The same runs, the first ones from all over the shape.
std::vector<CellRun> spread(const std::vector<CellRun>& runs)
{
    std::vector<CellRun> order{runs.front()};
    for (std::size_t step = std::bit_ceil(runs.size()) / 2; step > 0; step /= 2)
        for (std::size_t i = step; i < runs.size(); i += 2 * step) order.push_back(runs[i]);
    return order;
}

}  // namespace

UprightIsland upright_island(const Outline& outline)
{
    UprightIsland island{{}, &outline.loops, upright_turn(outline), {}};
    island.up = island.turn * outline.up;
    island.points = turned_by(outline.points, island.turn);
    island.corner = island.points.colwise().minCoeff();
    island.points.rowwise() -= island.corner;
    island.extent = island.points.maxCoeff();
    for (const VertexLoop& loop : outline.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            island.area += 0.5 * across(island.points.row(loop[i]), island.points.row(loop[(i + 1) % loop.size()]));
    return island;
}

UprightIsland turned_island(const UprightIsland& island, const Complex& turn)
{
    UprightIsland turned = island;
    turned.points = turned_by(island.points, turn);
    const Eigen::RowVector2d corner = turned.points.colwise().minCoeff();
    turned.points.rowwise() -= corner;
    turned.extent = turned.points.maxCoeff();
    turned.turn = turn * island.turn;
    turned.up = turn * island.up;
    const Complex moved = turn * Complex(island.corner[0], island.corner[1]) + Complex(corner[0], corner[1]);
    turned.corner = {moved.real(), moved.imag()};
    return turned;
}

std::array<double, 4> upright_by_turn(const UprightIsland& island)
{
    std::array<double, 4> upright = {1.0, 0.0, 0.0, 0.0};
    for (std::size_t t = 0; t < 4 && island.up != 0.0; ++t) upright[t] = (quarters[t] * island.up).imag();
    return upright;
}

UprightIsland most_upright(const UprightIsland& island)
{
    const std::array<double, 4> upright = upright_by_turn(island);
    return turned_island(island, quarters[std::ranges::max_element(upright) - upright.begin()]);
}

DrawnTurns draw_island(const UprightIsland& island, double scale, std::int64_t reach)
{
    std::array<std::vector<GridLoop>, 2> loops;
    for (const VertexLoop& loop : *island.loops) {
        GridLoop straight, across;
        for (const Index v : loop) {
            const GridPoint at = {std::llround(scale * island.points(v, 0)), std::llround(scale * island.points(v, 1))};
            if (!straight.empty() && straight.back() == at) continue;
            straight.push_back(at);
            across.push_back({-at[1], at[0]});
        }
        loops[0].push_back(std::move(straight));
        loops[1].push_back(std::move(across));
    }
    DrawnTurns turns;
    for (int t = 0; t < 2; ++t) {
        turns[t].shape = cells_near(loops[t], reach);
        turns[t + 2].shape = half_turn(turns[t].shape);
    }
    for (DrawnTurn& turn : turns) turn.order = spread(turn.shape.runs);
    return turns;
}

CellShape cells_on_board(const Outline& outline, int side, double margin)
{
    const double unit = static_cast<double>(side) * static_cast<double>(grid_cell);
    const auto reach = static_cast<std::int64_t>(std::ceil(0.5 * margin * unit)) + 1;  // points are rounded
    std::vector<GridLoop> loops;
    for (const VertexLoop& loop : outline.loops) {
        GridLoop& drawn = loops.emplace_back();
        for (const Eigen::RowVector2d& at : clipped(outline.points(loop, Eigen::all)))
            drawn.push_back({std::llround(unit * at[0]), std::llround(unit * at[1])});
        if (drawn.empty()) loops.pop_back();
    }
    if (loops.empty()) return {};
    CellShape shape = cells_near(loops, reach, true);
    std::vector<CellRun> runs;
    for (CellRun run : shape.runs) {
        run.row += static_cast<int>(shape.origin[1] / grid_cell);
        run.from = std::max(0, run.from + static_cast<int>(shape.origin[0] / grid_cell));
        run.to = std::min(side, run.to + static_cast<int>(shape.origin[0] / grid_cell));
        if (run.row >= 0 && run.row < side && run.from < run.to) runs.push_back(run);
    }
    return {side, side, std::move(runs)};
}

std::vector<DrawnTurns> draw_islands(const std::vector<UprightIsland>& islands, double scale, double unit,
                                     double margin)
{
    const auto reach = static_cast<std::int64_t>(std::ceil(0.5 * margin * unit)) + 1;  // points are rounded
    std::vector<DrawnTurns> drawn;
    for (const UprightIsland& island : islands) drawn.push_back(draw_island(island, scale * unit, reach));
    return drawn;
}

double largest_scale(const std::vector<UprightIsland>& islands, double margin, std::size_t tiles)
{
    double area = 0.0, along = 0.0, extent = 0.0;
    for (const UprightIsland& island : islands) {
        area += std::max(island.area, 0.0);
        along += margin * island.extent;
        extent = std::max(extent, island.extent);
    }
    if (!(extent > 0.0)) return 1.0;
    const double rest =
        static_cast<double>(tiles) - static_cast<double>(islands.size()) * EIGEN_PI / 4.0 * margin * margin;
    return std::min((1.0 - margin) / extent, 2.0 * rest / (along + std::sqrt(along * along + 4.0 * area * rest)));
}

IslandPlace place_of_spot(const UprightIsland& island, const DrawnTurns& turns, const CellSpot& spot, double unit,
                          double scale)
{
    const GridPoint& origin = turns[spot.turn].shape.origin;
    const Complex corner(island.corner[0], island.corner[1]);
    const Complex cells(static_cast<double>(spot.x * grid_cell - origin[0]),
                        static_cast<double>(spot.y * grid_cell - origin[1]));
    return {quarters[spot.turn] * island.turn, cells / unit - scale * (quarters[spot.turn] * corner)};
}

int board_side(std::size_t count)
{
    const double words = std::ceil(cells_an_island * std::sqrt(static_cast<double>(count)) / word_bits);
    return std::max(least_side, word_bits * static_cast<int>(words));
}

double most_margin(std::size_t count)
{
    return share_of_margins / std::sqrt(static_cast<double>(std::max<std::size_t>(count, 1)));
}

void require_finite_outlines(const std::vector<Outline>& outlines)
{
    for (const Outline& outline : outlines)
        if (!outline.points.allFinite()) throw SolverError("an island to pack has a point that is NaN or infinite");
}

PlanarPoints place_island(const PlanarPoints& points, const IslandPlace& place, double scale)
{
    PlanarPoints at = scale * turned_by(points, place.turn);
    at.rowwise() += Eigen::RowVector2d(place.offset.real(), place.offset.imag());
    return at;
}

}  // namespace koebe
