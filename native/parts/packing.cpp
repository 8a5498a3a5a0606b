#include "parts/packing.h"

#include "parts/cell_board.h"

#include "core/errors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr int least_side = 1024;           // cells along the square,
constexpr double cells_an_island = 32.0;   // and at least this times the root of the number of islands
constexpr double share_of_margins = 0.25;  // most margin, over an island's side if all were equal squares
constexpr double worth_a_turn = 0.999;     // of the area of the box: a turn must make it smaller than this
constexpr std::size_t most_sides = 1000;   // sides of the hull along which boxes are tried
constexpr double next_scale = 0.95;        // times the last while nothing fits, by the share of what does,
constexpr double least_factor = 0.8;
constexpr int most_scales = 600;
constexpr double first_step = 0.04, last_step = 0.0005;  // larger by that share, halved where that has no room,
constexpr double last_step_of_many = 0.008;
constexpr std::size_t many_islands = 200;
constexpr double least_gain = 0.002;   // and what a further attempt has to bring
constexpr int attempts_an_order = 24;  // before a new order is begun
constexpr int most_attempts = 400;
constexpr std::int64_t tests_a_point = 1200;  // tests on the board, after which no further attempt is made
constexpr std::int64_t fewest_tests = 1'000'000, most_tests = 40'000'000;
constexpr std::int64_t tests_an_attempt = 4000;  // to empty the board
constexpr std::size_t most_open = 16;            // sheets on which room is looked for
constexpr double similar = 0.8;                  // area over that of the island before which all places were looked at

enum class Rule { lowest_top, lowest, smallest_square };
constexpr std::array rules = {Rule::lowest_top, Rule::lowest, Rule::smallest_square};

constexpr std::array<Complex, 4> quarters = {Complex(1, 0), Complex(0, 1), Complex(-1, 0), Complex(0, -1)};

double across(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Indices of the corners of the convex hull, counter-clockwise.
std::vector<Eigen::Index> hull(const PlanarPoints& points)
{
    std::vector<Eigen::Index> order(static_cast<std::size_t>(points.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](Eigen::Index i) { return std::array{points(i, 0), points(i, 1)}; });
    std::vector<Eigen::Index> corners;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = corners.size();
        for (const Eigen::Index i : order) {
            while (corners.size() >= first + 2 &&
                   !(across(points.row(corners.back()) - points.row(corners[corners.size() - 2]),
                            points.row(i) - points.row(corners.back())) > 0.0))
                corners.pop_back();
            corners.push_back(i);
        }
        corners.pop_back();
        std::ranges::reverse(order);
    }
    return corners;
}

PlanarPoints turned(const PlanarPoints& points, const Complex& turn)
{
    PlanarPoints at(points.rows(), 2);
    at.col(0) = turn.real() * points.col(0) - turn.imag() * points.col(1);
    at.col(1) = turn.imag() * points.col(0) + turn.real() * points.col(1);
    return at;
}

Eigen::RowVector2d extent(const PlanarPoints& points)
{
    return points.colwise().maxCoeff() - points.colwise().minCoeff();
}

/// The turn that lays the smallest rectangle round the points along the axes, its long side upright.
Complex upright_turn(const Outline& outline)
{
    const PlanarPoints corners = outline.points(hull(outline.points), Eigen::all);
    const auto count = outline.along_axes ? 0 : static_cast<std::size_t>(corners.rows());
    Complex best = 1.0;
    Eigen::RowVector2d size = extent(corners);
    for (std::size_t i = 0; i < count; i += count / most_sides + 1) {
        const Eigen::RowVector2d side = corners.row((i + 1) % count) - corners.row(i);
        const double length = side.norm();
        if (!(length > 0.0)) continue;
        const Complex turn(side[0] / length, -side[1] / length);
        const Eigen::RowVector2d own = extent(turned(corners, turn));
        if (!(own.prod() < worth_a_turn * size.prod())) continue;
        best = turn;
        size = own;
    }
    return size[0] > size[1] ? Complex(-best.imag(), best.real()) : best;
}

struct Island {
    PlanarPoints points;  ///< upright, the lower left corner of their box at 0
    const std::vector<VertexLoop>* loops;
    Complex turn;
    Eigen::RowVector2d corner;  ///< of the box, before
    double area = 0.0, extent = 0.0;
};

Island upright(const Outline& outline)
{
    Island island{{}, &outline.loops, upright_turn(outline), {}};
    island.points = turned(outline.points, island.turn);
    island.corner = island.points.colwise().minCoeff();
    island.points.rowwise() -= island.corner;
    island.extent = island.points.maxCoeff();
    for (const VertexLoop& loop : outline.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            island.area += 0.5 * across(island.points.row(loop[i]), island.points.row(loop[(i + 1) % loop.size()]));
    return island;
}

struct Drawn {
    CellShape shape;
    std::vector<CellRun> order;  ///< of tests
};

using Turns = std::array<Drawn, 4>;

struct Spot {
    int turn = 0, x = 0, y = 0;
};

/// The same runs, the first ones from all over the shape.
std::vector<CellRun> spread(const std::vector<CellRun>& runs)
{
    std::vector<CellRun> order{runs.front()};
    for (std::size_t step = std::bit_ceil(runs.size()) / 2; step > 0; step /= 2)
        for (std::size_t i = step; i < runs.size(); i += 2 * step) order.push_back(runs[i]);
    return order;
}

/// @param scale grid units of a unit of the points
Turns drawn(const Island& island, double scale, std::int64_t reach)
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
    Turns turns;
    for (int t = 0; t < 2; ++t) {
        turns[t].shape = cells_near(loops[t], reach);
        turns[t + 2].shape = half_turn(turns[t].shape);
    }
    for (Drawn& turn : turns) turn.order = spread(turn.shape.runs);
    return turns;
}

/// @param unit grid units of the square's side @param scale of the island, in sides of the square
IslandPlace place_at(const Island& island, const Turns& turns, const Spot& spot, double unit, double scale)
{
    const GridPoint& origin = turns[spot.turn].shape.origin;
    const Complex corner(island.corner[0], island.corner[1]);
    const Complex cells(static_cast<double>(spot.x * grid_cell - origin[0]),
                        static_cast<double>(spot.y * grid_cell - origin[1]));
    return {quarters[spot.turn] * island.turn, cells / unit - scale * (quarters[spot.turn] * corner)};
}

int side_for(std::size_t count)
{
    int side = least_side;
    while (side < cells_an_island * std::sqrt(static_cast<double>(count))) side *= 2;
    return side;
}

class Packer {
public:
    Packer(const std::vector<Outline>& outlines, double margin)
        : side_(side_for(outlines.size())),
          unit_(static_cast<double>(side_) * grid_cell),
          margin_(std::min(margin, share_of_margins / std::sqrt(static_cast<double>(outlines.size())))),
          is_many_(outlines.size() >= many_islands),
          board_(side_)
    {
        std::int64_t points = 0;
        for (const Outline& outline : outlines) {
            islands_.push_back(upright(outline));
            points += outline.points.rows();
        }
        allowed_ = std::clamp(tests_a_point * points, fewest_tests, most_tests);
    }

    Packing pack()
    {
        std::vector<std::size_t> order = by_size(0);
        double scale = largest_scale();
        for (int k = 0; !fits(order, rules[0], scale);
             scale *= is_many_ || failed_ == 0 ? std::clamp(std::sqrt(room_), least_factor, next_scale) : next_scale)
            if (++k == most_scales) throw SolverError("the islands have no room in the square");
        grow(order, rules[0], first_step);
        std::int64_t work = board_.tests();
        for (int k = 1; k < most_attempts && islands_.size() > 1 && work < allowed_; ++k) {
            const Rule rule = rules[static_cast<std::size_t>(k) % rules.size()];
            if (k == static_cast<int>(rules.size()) || k % attempts_an_order == 0) order = by_size(k);
            if (fits(order, rule, best_scale_ * (1.0 + least_gain)))
                grow(order, rule, 0.5 * first_step);
            else if (failed_ > 0)  // the island that found no room comes earlier
                std::rotate(order.begin() + static_cast<std::ptrdiff_t>(random() % failed_),
                            order.begin() + static_cast<std::ptrdiff_t>(failed_),
                            order.begin() + static_cast<std::ptrdiff_t>(failed_) + 1);
            work = board_.tests() + k * tests_an_attempt;
        }
        return result();
    }

private:
    std::uint64_t random()
    {
        random_ = random_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return random_ >> 33;
    }

    /// The largest scale that can have room: each island takes at least its area, half the margin along its extent on
    /// both sides, and a disk of the margin's width.
    double largest_scale() const
    {
        double area = 0.0, along = 0.0, extent = 0.0;
        for (const Island& island : islands_) {
            area += std::max(island.area, 0.0);
            along += margin_ * island.extent;
            extent = std::max(extent, island.extent);
        }
        if (!(extent > 0.0)) return 1.0;
        const double rest = 1.0 - static_cast<double>(islands_.size()) * EIGEN_PI / 4.0 * margin_ * margin_;
        return std::min((1.0 - margin_) / extent, 2.0 * rest / (along + std::sqrt(along * along + 4.0 * area * rest)));
    }

    /// The order: first by falling area, then by falling extent, then by areas with random factors.
    std::vector<std::size_t> by_size(int round)
    {
        std::vector<double> size;
        for (const Island& island : islands_) {
            const double factor = round == 0 ? 1.0 : 0.4 + std::ldexp(static_cast<double>(random()), -31);
            size.push_back(round == static_cast<int>(rules.size()) ? island.extent : factor * island.area);
        }
        std::vector<std::size_t> order(islands_.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return size[k]; });
        return order;
    }

    void grow(const std::vector<std::size_t>& order, Rule rule, double step)
    {
        const double last = is_many_ ? last_step_of_many : last_step;
        while (step > last)
            if (const double scale = best_scale_ * (1.0 + step); scale > largest_scale() || !fits(order, rule, scale))
                step *= 0.5;
    }

    /// Whether all islands find room at that scale. If so, it becomes the best scale.
    bool fits(const std::vector<std::size_t>& order, Rule rule, double scale)
    {
        failed_ = 0;
        if (scale != drawn_scale_) {
            const auto reach = static_cast<std::int64_t>(std::ceil(0.5 * margin_ * unit_)) + 1;  // points are rounded
            drawn_.clear();
            for (const Island& island : islands_) drawn_.push_back(drawn(island, scale * unit_, reach));
            drawn_scale_ = scale;
        }
        std::int64_t cells = 0, taken = 0;
        for (const Turns& turns : drawn_) cells += turns[0].shape.cells();
        room_ = static_cast<double>(side_) * side_ / static_cast<double>(cells);
        if (room_ < 1.0) return false;
        board_.clear();
        std::vector<Spot> spots(islands_.size());
        int from = 0;
        double area = std::numeric_limits<double>::infinity();
        for (; failed_ < order.size(); ++failed_) {
            const std::size_t k = order[failed_];
            if (islands_[k].area < similar * area) {
                area = islands_[k].area;
                from = 0;
            }
            if (!place(drawn_[k], rule, from, spots[k])) {
                room_ = static_cast<double>(taken) / static_cast<double>(cells);
                return false;
            }
            taken += drawn_[k][0].shape.cells();
            // Lower rows are full for the next island.
            from = is_many_ ? spots[k].y : std::max(0, spots[k].y - drawn_[k][0].shape.height / 2);
        }
        places_.clear();
        for (std::size_t k = 0; k < islands_.size(); ++k)
            places_.push_back(place_at(islands_[k], drawn_[k], spots[k], unit_, scale));
        best_scale_ = scale;
        return true;
    }

    /// @param from row below which no room is looked for
    bool place(const Turns& turns, Rule rule, int from, Spot& spot)
    {
        std::array<int, 3> best = {INT_MAX, 0, 0};
        const int tried = islands_.size() == 1 ? 1 : 4;  // one alone stands upright
        for (int t = 0; t < tried; ++t) {
            const CellShape& shape = turns[t].shape;
            for (int y = from; y + shape.height <= side_; ++y) {
                const int top = y + shape.height;
                if ((rule == Rule::lowest ? y : top) > best[0]) break;
                const int x = board_.first_room(shape, turns[t].order, y);
                if (x < 0) continue;
                const int right = x + shape.width;
                std::array<int, 3> score = {top, right, t};
                if (rule == Rule::lowest) score = {y, right, t};
                if (rule == Rule::smallest_square) score = {std::max(top, right), top + right, t};
                if (score < best) {
                    best = score;
                    spot = {t, x, y};
                }
                if (rule != Rule::smallest_square) break;
            }
        }
        if (best[0] == INT_MAX) return false;
        board_.take(turns[spot.turn].shape, spot.x, spot.y);
        return true;
    }

    Packing result() { return {std::move(places_), best_scale_, margin_}; }

    const int side_;     // cells
    const double unit_;  // grid units
    const double margin_;
    const bool is_many_;
    std::vector<Island> islands_;
    CellBoard board_;
    std::int64_t allowed_ = 0;  // work
    std::vector<Turns> drawn_;
    double drawn_scale_ = 0.0, best_scale_ = 0.0;
    std::vector<IslandPlace> places_;
    std::size_t failed_ = 0;  // place in the order of the island that found no room
    double room_ = 0.0;       // share of the islands' cells that found room, or at most would
    std::uint64_t random_ = 1;
};

/// A board for each sheet, of which the cells beyond the sheet are taken.
class SheetPacker {
public:
    SheetPacker(const std::vector<Outline>& outlines, double margin, const SheetSize& sheet)
        : side_(side_for(outlines.size())),
          unit_(static_cast<double>(side_) * grid_cell / std::max(sheet.width, sheet.height)),
          columns_(cells_of(sheet.width)),
          rows_(cells_of(sheet.height))
    {
        const auto reach = static_cast<std::int64_t>(std::ceil(0.5 * margin * unit_)) + 1;
        for (const Outline& outline : outlines) {
            islands_.push_back(upright(outline));
            const bool is_larger = islands_.back().extent + margin > 1.01 * std::max(sheet.width, sheet.height);
            drawn_.push_back(is_larger ? Turns{} : drawn(islands_.back(), unit_, reach));
        }
    }

    SheetPacking pack(double margin)
    {
        std::vector<std::size_t> order(islands_.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return islands_[k].area; });
        SheetPacking packing{std::vector<IslandPlace>(islands_.size()), std::vector<int>(islands_.size(), -1), 0};
        for (const std::size_t k : order) {
            const Complex corner(islands_[k].corner[0], islands_[k].corner[1]);
            packing.places[k] = {islands_[k].turn, 0.5 * margin * Complex(1.0, 1.0) - corner};
            Spot spot;
            if (!has_room_on_empty(drawn_[k])) continue;
            std::size_t open = 0;
            while (open < boards_.size() && !find(boards_[open], drawn_[k], spot)) ++open;
            if (open == boards_.size()) {
                if (open == most_open) boards_.erase(boards_.begin());
                boards_.push_back(empty());
                open = boards_.size() - 1;
                ++packing.sheets;
                if (!find(boards_[open], drawn_[k], spot)) throw SolverError("an island has no room on its sheet");
            }
            boards_[open].take(drawn_[k][spot.turn].shape, spot.x, spot.y);
            packing.sheet[k] = packing.sheets - static_cast<int>(boards_.size() - open);
            const double length = static_cast<double>(grid_cell) * side_ / unit_;
            packing.places[k] = place_at(islands_[k], drawn_[k], spot, unit_ * length, 1.0 / length);
            packing.places[k].offset *= length;
        }
        return packing;
    }

private:
    int cells_of(double length) const
    {
        return static_cast<int>(std::floor(length * unit_ / static_cast<double>(grid_cell) * (1.0 + 1e-12)));
    }

    CellBoard empty() const
    {
        CellBoard board(side_);
        CellShape beyond;
        for (int row = 0; row < side_; ++row)
            if (const int from = row < rows_ ? columns_ : 0; from < side_) beyond.runs.push_back({row, from, side_});
        board.take(beyond, 0, 0);
        return board;
    }

    bool has_room_on_empty(const Turns& turns) const
    {
        return std::ranges::any_of(turns, [&](const Drawn& turn) {
            return !turn.shape.runs.empty() && turn.shape.width <= columns_ && turn.shape.height <= rows_;
        });
    }

    /// The lowest place, then the leftmost.
    bool find(const CellBoard& board, const Turns& turns, Spot& spot) const
    {
        std::array<int, 2> best = {INT_MAX, INT_MAX};
        for (int t = 0; t < 4; ++t) {
            const CellShape& shape = turns[t].shape;
            for (int y = 0; y + shape.height <= rows_ && y + shape.height <= best[0]; ++y) {
                const int x = board.first_room(shape, turns[t].order, y);
                if (x < 0) continue;
                if (const std::array score = {y + shape.height, x + shape.width}; score < best) {
                    best = score;
                    spot = {t, x, y};
                }
                break;
            }
        }
        return best[0] < INT_MAX;
    }

    const int side_;
    const double unit_;  // grid units in a unit of the points
    const int columns_, rows_;
    std::vector<Island> islands_;
    std::vector<Turns> drawn_;
    std::vector<CellBoard> boards_;  // of the last sheets
};

void require_finite_outlines(const std::vector<Outline>& outlines)
{
    for (const Outline& outline : outlines)
        if (!outline.points.allFinite()) throw SolverError("an island to pack has a point that is NaN or infinite");
}

}  // namespace

Packing pack_islands(const std::vector<Outline>& outlines, double margin)
{
    if (outlines.empty()) return {{}, 1.0, margin};
    require_finite_outlines(outlines);
    return Packer(outlines, margin).pack();
}

SheetPacking pack_on_sheets(const std::vector<Outline>& outlines, double margin, const SheetSize& sheet)
{
    require_finite_outlines(outlines);
    return SheetPacker(outlines, margin, sheet).pack(margin);
}

PlanarPoints place_island(const PlanarPoints& points, const IslandPlace& place, double scale)
{
    PlanarPoints at = scale * turned(points, place.turn);
    at.rowwise() += Eigen::RowVector2d(place.offset.real(), place.offset.imag());
    return at;
}

}  // namespace koebe
