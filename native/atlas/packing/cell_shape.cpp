#include "packing/cell_shape.h"

#include "packing/bit_row.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace koebe {
namespace {

std::int64_t floor_ratio(std::int64_t a, std::int64_t b)
{
    const std::int64_t quotient = a / b;
    return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

std::int64_t ceil_ratio(std::int64_t a, std::int64_t b) { return -floor_ratio(-a, b); }

/// Rows of bits.
class Drawing {
public:
    Drawing(int width, int height)
        : width_(width),
          words_(static_cast<std::size_t>((width + word_bits - 1) / word_bits)),
          bits_(static_cast<std::size_t>(words_) * static_cast<std::size_t>(height), 0)
    {
    }
    void paint(int row, std::int64_t from, std::int64_t to)
    {
        const auto first = static_cast<int>(std::max<std::int64_t>(from, 0));
        const auto last = static_cast<int>(std::min<std::int64_t>(to, width_));
        if (first < last) set_bits(&bits_[static_cast<std::size_t>(row) * words_], first, last);
    }
    std::vector<CellRun> runs(int height) const
    {
        std::vector<CellRun> runs;
        for (int row = 0; row < height; ++row) {
            const std::uint64_t* words = &bits_[static_cast<std::size_t>(row) * words_];
            for (int column = 0; (column = next(words, column, 0)) < width_;) {
                const int end = std::min(width_, next(words, column, ~std::uint64_t{0}));
                runs.push_back({row, column, end});
                column = end;
            }
        }
        return runs;
    }

private:
    /// The first column from there on whose bit differs from those of `of`.
    int next(const std::uint64_t* words, int column, std::uint64_t of) const
    {
        for (std::size_t word = static_cast<std::size_t>(column / word_bits); word < words_; ++word, column = 0) {
            const std::uint64_t differs = (words[word] ^ of) & ~std::uint64_t{0} << (column % word_bits);
            if (differs != 0) return static_cast<int>(word) * word_bits + std::countr_zero(differs);
        }
        return width_;
    }

    int width_;
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
};

/// The cells nearer to an edge than `reach`. An octagon round the circle of that radius decides.
void paint_edge(GridPoint a, GridPoint b, std::int64_t reach, Drawing& drawing)
{
    if (a[1] > b[1]) std::swap(a, b);
    const std::int64_t flat = (reach * 42 + 100) / 100;  // half a side of the octagon, tan(pi/8) of the reach or more
    const std::int64_t rise = b[1] - a[1], run = b[0] - a[0];
    const std::int64_t last = ceil_ratio(b[1] + reach, grid_cell);
    for (std::int64_t row = floor_ratio(a[1] - reach, grid_cell); row < last; ++row) {
        const std::int64_t low = row * grid_cell, high = low + grid_cell;
        std::int64_t from = INT64_MAX, to = INT64_MIN;
        // Along the edge, the reach of the octagon within the row is a concave function.
        const auto consider = [&](std::int64_t left, std::int64_t right, std::int64_t y) {
            const std::int64_t away = std::max<std::int64_t>({low - y, y - high, 0});
            if (away > reach) return;
            const std::int64_t half = away <= flat ? reach : reach + flat - away;
            from = std::min(from, left - half);
            to = std::max(to, right + half);
        };
        consider(a[0], a[0], a[1]);
        consider(b[0], b[0], b[1]);
        for (const std::int64_t y : {low - reach, low - flat, high + flat, high + reach})
            if (y > a[1] && y < b[1]) {
                const std::int64_t left = floor_ratio(run * (y - a[1]), rise);
                consider(a[0] + left, a[0] + left + 1, y);
            }
        if (from < to) drawing.paint(static_cast<int>(row), floor_ratio(from, grid_cell), ceil_ratio(to, grid_cell));
    }
}

/// The cells whose middle is inside.
void paint_inside(const std::vector<GridLoop>& loops, int height, Drawing& drawing)
{
    std::vector<std::vector<std::pair<std::int64_t, int>>> crossings(static_cast<std::size_t>(height));
    for (const GridLoop& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            GridPoint a = loop[i], b = loop[(i + 1) % loop.size()];
            const int sign = a[1] < b[1] ? 1 : -1;
            if (sign < 0) std::swap(a, b);
            for (std::int64_t row = ceil_ratio(a[1] - grid_cell / 2, grid_cell); row * grid_cell + grid_cell / 2 < b[1];
                 ++row) {
                const std::int64_t y = row * grid_cell + grid_cell / 2;
                const std::int64_t x = a[0] + floor_ratio((b[0] - a[0]) * (y - a[1]), b[1] - a[1]);
                crossings[static_cast<std::size_t>(row)].emplace_back(floor_ratio(x, grid_cell), sign);
            }
        }
    for (int row = 0; row < height; ++row) {
        auto& own = crossings[static_cast<std::size_t>(row)];
        std::ranges::sort(own);
        int winding = 0;
        for (std::size_t i = 0; i + 1 < own.size(); ++i)
            if ((winding += own[i].second) != 0) drawing.paint(row, own[i].first, own[i + 1].first);
    }
}

}  // namespace

std::int64_t CellShape::cells() const
{
    std::int64_t sum = 0;
    for (const CellRun& run : runs) sum += run.to - run.from;
    return sum;
}

CellShape cells_near(const std::vector<GridLoop>& loops, std::int64_t reach, bool on_board)
{
    // The box of all within reach. On a board it begins at a whole cell.
    GridPoint least = {INT64_MAX, INT64_MAX}, most = {INT64_MIN, INT64_MIN};
    for (const GridLoop& loop : loops)
        for (const GridPoint& point : loop)
            for (int k = 0; k < 2; ++k) {
                least[k] = std::min(least[k], point[k] - reach);
                most[k] = std::max(most[k], point[k] + reach);
            }
    if (on_board)
        for (std::int64_t& low : least) low = grid_cell * floor_ratio(low, grid_cell);
    CellShape shape;
    shape.origin = least;
    shape.width = static_cast<int>(ceil_ratio(most[0] - least[0], grid_cell));
    shape.height = static_cast<int>(ceil_ratio(most[1] - least[1], grid_cell));
    // Paint the cells near edges, then those inside.
    std::vector<GridLoop> moved = loops;
    for (GridLoop& loop : moved)
        for (GridPoint& point : loop)
            for (int k = 0; k < 2; ++k) point[k] -= least[k];
    Drawing drawing(shape.width, shape.height);
    for (const GridLoop& loop : moved)
        for (std::size_t i = 0; i < loop.size(); ++i) paint_edge(loop[i], loop[(i + 1) % loop.size()], reach, drawing);
    paint_inside(moved, shape.height, drawing);
    shape.runs = drawing.runs(shape.height);
    return shape;
}

CellShape half_turn(const CellShape& shape)
{
    CellShape turned = shape;
    turned.origin = {-shape.origin[0] - shape.width * grid_cell, -shape.origin[1] - shape.height * grid_cell};
    std::ranges::reverse(turned.runs);
    for (CellRun& run : turned.runs) run = {shape.height - 1 - run.row, shape.width - run.to, shape.width - run.from};
    return turned;
}

}  // namespace koebe
