#include "packing/sheet_packing.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "cost/tolerances.h"
#include "packing/packed_island.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace koebe {
namespace {

constexpr std::size_t most_open = 16;  // sheets on which room is looked for

/// A board for a sheet, of which the cells beyond the sheet are taken.
struct OpenSheet {
    CellBoard board;
    int from = 0;  ///< row below which no room is looked for
};

class SheetPacker {
public:
    SheetPacker(const std::vector<Outline>& outlines, double margin, const SheetSize& sheet)
        : side_(board_side(outlines.size())),
          unit_(static_cast<double>(side_) * grid_cell / std::max(sheet.width, sheet.height)),
          columns_(cells_of(sheet.width)),
          rows_(cells_of(sheet.height))
    {
        const auto reach = static_cast<std::int64_t>(std::ceil(0.5 * margin * unit_)) + 1;
        for (const Outline& outline : outlines) {
            islands_.push_back(upright_island(outline));
            const bool is_larger = islands_.back().extent + margin > 1.01 * std::max(sheet.width, sheet.height);
            drawn_.push_back(is_larger ? DrawnTurns{} : draw_island(islands_.back(), unit_, reach));
        }
    }

    SheetPacking pack(double margin)
    {
        // The largest island first, each on the first open sheet with room; without one on a new sheet.
        std::vector<std::size_t> order = numbers_below<std::size_t>(islands_.size());
        std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return islands_[k].area; });
        SheetPacking packing{std::vector<IslandPlace>(islands_.size()), std::vector<int>(islands_.size(), -1), 0};
        double area = std::numeric_limits<double>::infinity();
        for (const std::size_t k : order) {
            if (islands_[k].area < tolerance::similar_area * area) {
                area = islands_[k].area;
                for (OpenSheet& sheet : sheets_) sheet.from = 0;
            }
            const Complex corner(islands_[k].corner[0], islands_[k].corner[1]);
            packing.places[k] = {islands_[k].turn, 0.5 * margin * Complex(1.0, 1.0) - corner};
            CellSpot spot;
            if (!has_room_on_empty(drawn_[k])) continue;
            std::size_t open = 0;
            while (open < sheets_.size() && !find(sheets_[open], drawn_[k], spot)) ++open;
            if (open == sheets_.size()) {
                if (open == most_open) sheets_.erase(sheets_.begin());
                sheets_.push_back({empty()});
                open = sheets_.size() - 1;
                ++packing.sheets;
                if (!find(sheets_[open], drawn_[k], spot)) throw SolverError("an island has no room on its sheet");
            }
            sheets_[open].board.take(drawn_[k][spot.turn].shape, spot.x, spot.y);
            if (islands_.size() >= many_islands) sheets_[open].from = spot.y;
            packing.sheet[k] = packing.sheets - static_cast<int>(sheets_.size() - open);
            const double length = static_cast<double>(grid_cell) * side_ / unit_;
            packing.places[k] = place_of_spot(islands_[k], drawn_[k], spot, unit_ * length, 1.0 / length);
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

    bool has_room_on_empty(const DrawnTurns& turns) const
    {
        return std::ranges::any_of(turns, [&](const DrawnTurn& turn) {
            return !turn.shape.runs.empty() && turn.shape.width <= columns_ && turn.shape.height <= rows_;
        });
    }

    /// The lowest place, then the leftmost.
    bool find(OpenSheet& sheet, const DrawnTurns& turns, CellSpot& spot) const
    {
        std::array<int, 2> best = {INT_MAX, INT_MAX};
        for (int t = 0; t < 4; ++t) {
            const CellShape& shape = turns[t].shape;
            for (int y = sheet.from; y + shape.height <= rows_ && y + shape.height <= best[0]; ++y) {
                const int x = sheet.board.first_room(shape, turns[t].order, y);
                if (x < 0) continue;
                if (const std::array score = {y + shape.height, x + shape.width}; score < best) {
                    best = score;
                    spot = {t, x, y};
                }
                break;
            }
        }
        const bool is_found = best[0] < INT_MAX;
        if (!is_found && islands_.size() >= many_islands) sheet.from = rows_;
        return is_found;
    }

    const int side_;
    const double unit_;  // grid units in a unit of the points
    const int columns_, rows_;
    std::vector<UprightIsland> islands_;
    std::vector<DrawnTurns> drawn_;
    std::vector<OpenSheet> sheets_;  // the last ones
};

}  // namespace

SheetPacking pack_on_sheets(const std::vector<Outline>& outlines, double margin, const SheetSize& sheet)
{
    require_finite_outlines(outlines);
    return SheetPacker(outlines, margin, sheet).pack(margin);
}

}  // namespace koebe
