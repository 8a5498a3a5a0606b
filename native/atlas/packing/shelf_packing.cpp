#include "packing/shelf_packing.h"

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
#include <utility>

namespace koebe {
namespace {

constexpr double worth_a_board = 0.65;                          // of the largest scale: if shelves reach it, they do
constexpr double units_of_shelves = 0x1p40;                     // along the square
constexpr int halvings_of_shelves = 40;                         // of the scales between which shelves have room
constexpr double least_shrinking = 0.4, most_shrinking = 0.95;  // of the scale, by the share that finds room
constexpr int most_shrinkings = 600;
constexpr double first_growth = 0.02, last_growth = 0.008;  // share of the scale, halved where that has no room

class ShelfPacker {
public:
    ShelfPacker(const std::vector<Outline>& outlines, double margin)
        : side_(board_side(outlines.size())), unit_(static_cast<double>(side_) * grid_cell), margin_(margin)
    {
        for (const Outline& outline : outlines) islands_.push_back(upright_island(outline));
        most_ = largest_scale(islands_, margin_);
    }

    IslandPacking pack()
    {
        if (!pack_boxes()) pack_on_board();
        return {std::move(places_), scale_, margin_};
    }

private:
    template <typename Size>
    std::vector<std::size_t> by_falling(Size&& size) const
    {
        std::vector<std::size_t> order = numbers_below<std::size_t>(islands_.size());
        std::ranges::stable_sort(order, std::greater<>(), size);
        return order;
    }

    /// @return whether shelves are about as good as a board
    bool pack_boxes()
    {
        std::vector<Eigen::RowVector2d> boxes;
        for (const UprightIsland& island : islands_) boxes.emplace_back(island.points.colwise().maxCoeff());
        const std::vector<std::size_t> order = by_falling([&](std::size_t k) { return boxes[k][1]; });
        constexpr auto side = static_cast<std::int64_t>(units_of_shelves);
        const auto gap = static_cast<std::int64_t>(std::ceil(margin_ * units_of_shelves));
        std::vector<std::array<std::int64_t, 2>> corners(islands_.size());
        const auto have_room = [&](double scale) {
            std::int64_t x = 0, y = 0, shelf = 0;
            for (const std::size_t k : order) {
                const auto width = static_cast<std::int64_t>(std::ceil(scale * boxes[k][0] * units_of_shelves)) + gap;
                const auto height = static_cast<std::int64_t>(std::ceil(scale * boxes[k][1] * units_of_shelves)) + gap;
                if (x + width > side) {
                    y += shelf;
                    x = shelf = 0;
                }
                shelf = std::max(shelf, height);
                if (width > side || y + height > side) return false;
                corners[k] = {x, y};
                x += width;
            }
            return true;
        };
        // The largest scale at which shelves have room, between the least that is worth it and the largest of all.
        double high = most_;
        scale_ = worth_a_board * most_;
        if (!have_room(scale_)) return false;
        for (int k = 0; k < halvings_of_shelves; ++k)
            if (const double middle = 0.5 * (scale_ + high); have_room(middle))
                scale_ = middle;
            else
                high = middle;
        have_room(scale_);
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            const auto place = [&](int c) {
                return (static_cast<double>(corners[k][c]) / units_of_shelves) + 0.5 * margin_;
            };
            Complex turn = islands_[k].turn, corner(islands_[k].corner[0], islands_[k].corner[1]);
            if (const auto upright = upright_by_turn(islands_[k]); upright[2] > upright[0]) {  // in the same box
                turn *= -1.0;
                corner = -corner - Complex(boxes[k][0], boxes[k][1]);
            }
            places_.push_back({turn, Complex(place(0), place(1)) - scale_ * corner});
        }
        return true;
    }

    void pack_on_board()
    {
        const std::vector<std::size_t> order = by_falling([&](std::size_t k) { return islands_[k].area; });
        CellBoard board(side_);
        double scale = most_;
        for (int k = 0; !fits(order, scale, board);
             scale *= std::clamp(std::sqrt(room_), least_shrinking, most_shrinking))
            if (++k == most_shrinkings) throw SolverError("the islands have no room in the square");
        for (double growth = first_growth; growth > last_growth;)
            if (const double larger = scale_ * (1.0 + growth); larger > most_ || !fits(order, larger, board))
                growth *= 0.5;
    }

    /// Whether all islands find room at that scale. If so, their places are kept.
    bool fits(const std::vector<std::size_t>& order, double scale, CellBoard& board)
    {
        const std::vector<DrawnTurns> drawn = draw_islands(islands_, scale, unit_, margin_);
        std::int64_t cells = 0, taken = 0;
        for (const DrawnTurns& turns : drawn) cells += turns[0].shape.cells();
        room_ = static_cast<double>(side_) * side_ / static_cast<double>(cells);
        if (room_ < 1.0) return false;
        board.clear();
        std::vector<CellSpot> spots(islands_.size());
        std::array<CellSpot, 4> reached{};  // by turns, up to where similar islands found no room
        double area = std::numeric_limits<double>::infinity();
        for (const std::size_t k : order) {
            if (islands_[k].area < tolerance::similar_area * area) {
                area = islands_[k].area;
                reached = {};
            }
            if (!place(drawn[k], reached, board, spots[k])) {
                room_ = static_cast<double>(taken) / static_cast<double>(cells);
                return false;
            }
            taken += drawn[k][0].shape.cells();
        }
        places_.clear();
        for (std::size_t k = 0; k < islands_.size(); ++k)
            places_.push_back(place_of_spot(islands_[k], drawn[k], spots[k], unit_, scale));
        scale_ = scale;
        return true;
    }

    /// Takes the place with the lowest top of all four turns.
    bool place(const DrawnTurns& turns, std::array<CellSpot, 4>& reached, CellBoard& board, CellSpot& spot) const
    {
        std::array<int, 3> best = {INT_MAX, 0, 0};
        for (int t = 0; t < 4; ++t) {
            const CellShape& shape = turns[t].shape;
            CellSpot& from = reached[static_cast<std::size_t>(t)];
            for (int y = from.y; y + shape.height <= side_ && y + shape.height <= best[0]; ++y) {
                const int x = board.first_room(shape, turns[t].order, y, y == from.y ? from.x : 0);
                from = {t, std::max(x, 0), x < 0 ? y + 1 : y};
                if (x < 0) continue;
                if (const std::array<int, 3> score = {y + shape.height, x + shape.width, t}; score < best) {
                    best = score;
                    spot = {t, x, y};
                }
                break;
            }
        }
        if (best[0] == INT_MAX) return false;
        board.take(turns[spot.turn].shape, spot.x, spot.y);
        return true;
    }

    const int side_;     // cells
    const double unit_;  // grid units
    const double margin_;
    std::vector<UprightIsland> islands_;
    double most_ = 0.0, scale_ = 0.0;  // the largest scale that can have room; the best one that has
    double room_ = 0.0;                // share of the islands' cells that found room, or at most would
    std::vector<IslandPlace> places_;
};

}  // namespace

IslandPacking pack_on_shelves(const std::vector<Outline>& outlines, double margin)
{
    return ShelfPacker(outlines, margin).pack();
}

}  // namespace koebe
