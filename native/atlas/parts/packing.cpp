#include "parts/packing.h"

#include "core/errors.h"
#include "parts/packed_island.h"
#include "parts/tight_packing.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double share_of_margins = 0.25;  // most margin, over an island's side if all were equal squares
constexpr double next_scale = 0.95;        // times the last while nothing fits, by the share of what does,
constexpr double least_factor = 0.8;
constexpr int most_scales = 600;
constexpr double first_step = 0.04, last_step = 0.0005;  // larger by that share, halved where that has no room,
constexpr double last_step_of_many = 0.008;
constexpr std::size_t many_islands = 200;
constexpr std::size_t crumbs = 1000;  // islands: each goes on where a similar one found room; no further attempts,
constexpr double least_factor_of_crumbs = 0.4, step_of_crumbs = 0.02;  // and fewer scales;
constexpr double worth_a_board = 0.65;    // of the largest scale: if rows of boxes reach it, they are taken
constexpr double units_of_rows = 0x1p40;  // along the square
constexpr int halvings_of_rows = 40;      // of the scales between which rows have room
constexpr double least_gain = 0.002;      // and what a further attempt has to bring
constexpr int attempts_an_order = 24;     // before a new order is begun
constexpr int most_attempts = 400;
constexpr std::int64_t tests_a_point = 1200;  // tests on the board, after which no further attempt is made
constexpr std::int64_t fewest_tests = 1'000'000, most_tests = 40'000'000;
constexpr std::int64_t tests_an_attempt = 4000;  // to empty the board
constexpr std::size_t most_tight = 100;          // islands that are packed more tightly,
constexpr std::int64_t words_a_point = 24'000;   // with so much work
constexpr std::int64_t fewest_words = 20'000'000, most_words = 200'000'000;
constexpr std::size_t few_islands = 3;   // other turns are tried for so few islands,
constexpr double held = 0.8;             // or if one is that long, in sides of the square, in the first packing
constexpr double worth_leaning = 1.025;  // times the scale: islands leave the upright for that
constexpr double similar = 0.8;          // area over that of the island before which all places were looked at

enum class Rule { lowest_top, lowest, smallest_square };
constexpr std::array rules = {Rule::lowest_top, Rule::lowest, Rule::smallest_square};

class Packer {
public:
    Packer(const std::vector<Outline>& outlines, double margin)
        : side_(board_side(outlines.size())),
          unit_(static_cast<double>(side_) * grid_cell),
          margin_(std::min(margin, share_of_margins / std::sqrt(static_cast<double>(outlines.size())))),
          is_many_(outlines.size() >= many_islands),
          are_crumbs_(outlines.size() >= crumbs),
          board_(side_)
    {
        std::int64_t points = 0;
        for (const Outline& outline : outlines) {
            islands_.push_back(upright_island(outline));
            points += outline.points.rows();
        }
        allowed_ = std::clamp(tests_a_point * points, fewest_tests, most_tests);
        if (outlines.size() <= most_tight) allowed_ = fewest_tests;
    }

    IslandPacking pack()
    {
        if (are_crumbs_ && pack_in_rows()) return result();
        std::vector<std::size_t> order = by_size(0);
        double scale = largest_scale();
        const double least = are_crumbs_ ? least_factor_of_crumbs : least_factor;
        for (int k = 0; !fits(order, rules[0], scale);
             scale *= is_many_ || failed_ == 0 ? std::clamp(std::sqrt(room_), least, next_scale) : next_scale)
            if (++k == most_scales) throw SolverError("the islands have no room in the square");
        grow(order, rules[0], are_crumbs_ ? step_of_crumbs : first_step);
        std::int64_t work = are_crumbs_ ? allowed_ : board_.tests();
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
        for (const UprightIsland& island : islands_) {
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
        for (const UprightIsland& island : islands_) {
            const double factor = round == 0 ? 1.0 : 0.4 + std::ldexp(static_cast<double>(random()), -31);
            size.push_back(round == static_cast<int>(rules.size()) ? island.extent : factor * island.area);
        }
        std::vector<std::size_t> order(islands_.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return size[k]; });
        return order;
    }

    /// Islands in their boxes side by side, in rows, the highest first. @return whether that is about as good as a
    /// board
    bool pack_in_rows()
    {
        std::vector<Eigen::RowVector2d> boxes;
        for (const UprightIsland& island : islands_) boxes.emplace_back(island.points.colwise().maxCoeff());
        std::vector<std::size_t> order(islands_.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return boxes[k][1]; });
        constexpr auto side = static_cast<std::int64_t>(units_of_rows);
        const auto gap = static_cast<std::int64_t>(std::ceil(margin_ * units_of_rows));
        std::vector<std::array<std::int64_t, 2>> corners(islands_.size());
        const auto have_room = [&](double scale) {
            std::int64_t x = 0, y = 0, row = 0;
            for (const std::size_t k : order) {
                const auto width = static_cast<std::int64_t>(std::ceil(scale * boxes[k][0] * units_of_rows)) + gap;
                const auto height = static_cast<std::int64_t>(std::ceil(scale * boxes[k][1] * units_of_rows)) + gap;
                if (x + width > side) {
                    y += row;
                    x = row = 0;
                }
                row = std::max(row, height);
                if (width > side || y + height > side) return false;
                corners[k] = {x, y};
                x += width;
            }
            return true;
        };
        const double most = largest_scale();
        double high = most;
        best_scale_ = worth_a_board * most;
        if (!have_room(best_scale_)) return false;
        for (int k = 0; k < halvings_of_rows; ++k)
            if (const double middle = 0.5 * (best_scale_ + high); have_room(middle))
                best_scale_ = middle;
            else
                high = middle;
        have_room(best_scale_);
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            const auto place = [&](int c) {
                return (static_cast<double>(corners[k][c]) / units_of_rows) + 0.5 * margin_;
            };
            const Complex corner(islands_[k].corner[0], islands_[k].corner[1]);
            places_.push_back({islands_[k].turn, Complex(place(0), place(1)) - best_scale_ * corner});
        }
        return true;
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
            for (const UprightIsland& island : islands_) drawn_.push_back(draw_island(island, scale * unit_, reach));
            drawn_scale_ = scale;
        }
        std::int64_t cells = 0, taken = 0;
        for (const DrawnTurns& turns : drawn_) cells += turns[0].shape.cells();
        room_ = static_cast<double>(side_) * side_ / static_cast<double>(cells);
        if (room_ < 1.0) return false;
        board_.clear();
        std::vector<CellSpot> spots(islands_.size());
        int from = 0;
        double area = std::numeric_limits<double>::infinity();
        for (; failed_ < order.size(); ++failed_) {
            const std::size_t k = order[failed_];
            if (islands_[k].area < similar * area) {
                area = islands_[k].area;
                from = 0;
                reached_ = {};
            }
            if (!place(drawn_[k], rule, from, spots[k])) {
                room_ = static_cast<double>(taken) / static_cast<double>(cells);
                return false;
            }
            taken += drawn_[k][0].shape.cells();
            // Lower rows are full for the next island.
            if (!are_crumbs_) from = is_many_ ? spots[k].y : std::max(0, spots[k].y - drawn_[k][0].shape.height / 2);
        }
        places_.clear();
        for (std::size_t k = 0; k < islands_.size(); ++k)
            places_.push_back(place_of_spot(islands_[k], drawn_[k], spots[k], unit_, scale));
        best_scale_ = scale;
        return true;
    }

    /// @param from row below which no room is looked for
    bool place(const DrawnTurns& turns, Rule rule, int from, CellSpot& spot)
    {
        std::array<int, 3> best = {INT_MAX, 0, 0};
        const int tried = islands_.size() == 1 ? 1 : 4;  // one alone stands upright
        for (int t = 0; t < tried; ++t) {
            const CellShape& shape = turns[t].shape;
            CellSpot& reached = reached_[static_cast<std::size_t>(t)];
            for (int y = std::max(from, reached.y); y + shape.height <= side_; ++y) {
                const int top = y + shape.height;
                if ((rule == Rule::lowest ? y : top) > best[0]) break;
                const int x = board_.first_room(shape, turns[t].order, y, y == reached.y ? reached.x : 0);
                if (are_crumbs_) reached = {t, std::max(x, 0), x < 0 ? y + 1 : y};
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

    IslandPacking result() { return {std::move(places_), best_scale_, margin_}; }

    const int side_;     // cells
    const double unit_;  // grid units
    const double margin_;
    const bool is_many_, are_crumbs_;
    std::vector<UprightIsland> islands_;
    CellBoard board_;
    std::array<CellSpot, 4> reached_;  // of crumbs: by turns, up to where similar islands found no room
    std::int64_t allowed_ = 0;         // work
    std::vector<DrawnTurns> drawn_;
    double drawn_scale_ = 0.0, best_scale_ = 0.0;
    std::vector<IslandPlace> places_;
    std::size_t failed_ = 0;  // place in the order of the island that found no room
    double room_ = 0.0;       // share of the islands' cells that found room, or at most would
    std::uint64_t random_ = 1;
};

/// The longest side of an upright island, in sides of the square.
double longest_side(const std::vector<Outline>& outlines, double scale)
{
    double most = 0.0;
    for (const Outline& outline : outlines) most = std::max(most, upright_island(outline).extent);
    return most * scale;
}

/// Replaces the packing by tighter ones. Islands leave the upright only if that makes them clearly larger.
void tighten(const std::vector<Outline>& outlines, IslandPacking& best)
{
    std::int64_t points = 0;
    for (const Outline& outline : outlines) points += outline.points.rows();
    const std::int64_t words = std::clamp(words_a_point * points, fewest_words, most_words);
    const auto attempt = [&](IslandTurns turns, double gain, std::int64_t most) {
        if (IslandPacking tight = pack_tightly(outlines, best.margin, turns, most); tight.scale > gain * best.scale)
            best = std::move(tight);
    };
    const bool is_held = outlines.size() <= few_islands || longest_side(outlines, best.scale) > held;
    attempt(IslandTurns::quarter, 1.0, is_held ? words / 2 : words);
    if (is_held) attempt(IslandTurns::free, worth_leaning, words / 2);
}

}  // namespace

IslandPacking pack_islands(const std::vector<Outline>& outlines, double margin)
{
    if (outlines.empty()) return {{}, 1.0, margin};
    require_finite_outlines(outlines);
    IslandPacking best = Packer(outlines, margin).pack();
    if (outlines.size() <= most_tight) tighten(outlines, best);
    return best;
}

}  // namespace koebe
