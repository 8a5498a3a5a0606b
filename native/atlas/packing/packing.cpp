#include "packing/packing.h"

#include "cost/tolerances.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "packing/packed_island.h"
#include "packing/separation.h"
#include "packing/shelf_packing.h"
#include "packing/tight_packing.h"

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

constexpr double next_scale = 0.95;  // times the last while nothing fits, by the share of what does,
constexpr double least_factor = 0.8;
constexpr int most_scales = 600;
constexpr double first_step = 0.04, last_step = 0.0005;  // larger by that share, halved where that has no room,
constexpr double last_step_of_many = 0.002;
constexpr std::size_t islands_on_shelves = 1000;  // so many islands are packed by shelf_packing.h
constexpr double least_gain = 0.002;              // what a further attempt has to bring
constexpr int attempts_an_order = 24;             // before a new order is begun
constexpr int most_attempts = 400;
constexpr std::int64_t tests_a_point = 1200;  // tests on the board, after which no further attempt is made
constexpr std::int64_t fewest_tests = 1'000'000, most_tests = 40'000'000;
constexpr std::int64_t tests_an_attempt = 4000;  // to empty the board
constexpr std::size_t most_tight = 100;          // islands that are packed more tightly,
constexpr std::int64_t words_a_point = 24'000;   // with so much work
constexpr std::int64_t fewest_words = 100'000'000, most_words = 200'000'000;
constexpr std::size_t few_islands = 3;   // other turns are tried for so few islands,
constexpr double held = 0.8;             // or if one is that long, in sides of the square, in the first packing
constexpr double worth_leaning = 1.025;  // times the scale: islands leave the upright for that
constexpr double worth_one_turn = 0.98;  // times the scale: less is given up so that equal islands lie alike
constexpr double least_scale = 1e-4;     // of the first one that is tried, beside islands that keep their place

enum class Rule { lowest_top, lowest, smallest_square };
constexpr std::array rules = {Rule::lowest_top, Rule::lowest, Rule::smallest_square};

class Packer {
public:
    Packer(const std::vector<Outline>& outlines, double margin, const PackingTime& time, const PackingSite& site = {})
        : side_(board_side(outlines.size())),
          unit_(static_cast<double>(side_) * grid_cell),
          margin_(margin),
          is_many_(outlines.size() >= many_islands),
          time_(time),
          most_scale_(site.most_scale),
          taken_(site.taken.size()),
          boards_(site.taken.size(), CellBoard(side_))
    {
        std::int64_t points = 0;
        for (const Outline& outline : outlines) {
            islands_.push_back(upright_island(outline));
            alike_.push_back(outline.alike);
            points += outline.points.rows();
        }
        allowed_ = std::clamp(tests_a_point * points, fewest_tests, most_tests);
        if (outlines.size() <= most_tight) allowed_ = fewest_tests;
        for (std::size_t t = 0; t < taken_.size(); ++t)
            for (const Outline& outline : site.taken[t]) taken_[t].push_back(cells_on_board(outline, side_, margin_));
        is_free_ = taken_.size() == 1 && taken_.front().empty();
        const bool is_last = outlines.size() > most_tight || !is_free_;  // no tighter packing follows
        if (is_last && time.is_used_up) allowed_ = INT64_MAX;
    }

    TilePacking pack()
    {
        std::vector<std::size_t> order = by_size(0);
        double scale = std::min(most_possible(), most_scale_);
        const double least = is_free_ ? 0.0 : least_scale * scale;
        for (int k = 0; !fits(order, rules[0], scale);
             scale *= is_many_ || failed_ == 0 ? std::clamp(std::sqrt(room_), least_factor, next_scale) : next_scale)
            if (++k == most_scales || scale < least) {
                if (is_free_) throw SolverError("the islands have no room in the square");
                throw InputError("the islands that keep their place leave no room for the others");
            }
        grow(order, rules[0], first_step);
        std::int64_t work = tests();
        const int most = allowed_ == INT64_MAX ? INT_MAX : most_attempts;
        for (int k = 1; k < most && islands_.size() > 1 && work < allowed_ && !is_over(); ++k) {
            const Rule rule = rules[static_cast<std::size_t>(k) % rules.size()];
            if (k == static_cast<int>(rules.size()) || k % attempts_an_order == 0) order = by_size(k);
            if (fits(order, rule, best_scale_ * (1.0 + least_gain)))
                grow(order, rule, 0.5 * first_step);
            else if (failed_ > 0)  // the island that found no room comes earlier
                std::rotate(order.begin() + static_cast<std::ptrdiff_t>(random() % failed_),
                            order.begin() + static_cast<std::ptrdiff_t>(failed_),
                            order.begin() + static_cast<std::ptrdiff_t>(failed_) + 1);
            work = tests() + k * tests_an_attempt;
        }
        if (islands_.size() > most_tight && std::ranges::count(alike_, 1) > 0) lay_alike();
        return result();
    }

private:
    std::int64_t tests() const
    {
        std::int64_t sum = 0;
        for (const CellBoard& board : boards_) sum += board.tests();
        return sum;
    }

    double most_possible() const { return largest_scale(islands_, margin_, boards_.size()); }

    std::uint64_t random()
    {
        random_ = random_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return random_ >> 33;
    }

    /// The order: first by falling area, then by falling extent, then by areas with random factors.
    std::vector<std::size_t> by_size(int round)
    {
        std::vector<double> size;
        for (const UprightIsland& island : islands_) {
            const double factor = round == 0 ? 1.0 : 0.4 + std::ldexp(static_cast<double>(random()), -31);
            size.push_back(round == static_cast<int>(rules.size()) ? island.extent : factor * island.area);
        }
        std::vector<std::size_t> order = numbers_below<std::size_t>(islands_.size());
        std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return size[k]; });
        return order;
    }

    /// Lays islands that are alike in one turn, if that costs little.
    void lay_alike()
    {
        const std::vector<UprightIsland> before = islands_;
        is_held_ = true;
        for (std::size_t k = 0; k < islands_.size(); ++k)
            if (alike_[k]) islands_[k] = most_upright(islands_[k]);
        drawn_scale_ = 0.0;
        const double least = worth_one_turn * best_scale_;
        for (const Rule rule : rules)
            if (fits(by_size(0), rule, least)) return grow(by_size(0), rule, 0.25 * first_step);
        islands_ = before;
    }

    void grow(const std::vector<std::size_t>& order, Rule rule, double step)
    {
        const double last = is_many_ ? last_step_of_many : last_step;
        while (step > last)
            if (const double scale = best_scale_ * (1.0 + step);
                scale > most_scale_ || is_over() || scale > most_possible() || !fits(order, rule, scale))
                step *= 0.5;
    }

    bool is_over() const { return best_scale_ >= most_scale_ || (time_.is_over && time_.is_over()); }

    /// Whether all islands find room at that scale. If so, it becomes the best scale.
    bool fits(const std::vector<std::size_t>& order, Rule rule, double scale)
    {
        failed_ = 0;
        if (scale != drawn_scale_) {
            drawn_ = draw_islands(islands_, scale, unit_, margin_);
            drawn_scale_ = scale;
        }
        std::int64_t cells = 0, taken = 0;
        for (const DrawnTurns& turns : drawn_) cells += turns[0].shape.cells();
        room_ = static_cast<double>(boards_.size()) * side_ * side_ / static_cast<double>(cells);
        if (room_ < 1.0) return false;
        for (std::size_t t = 0; t < boards_.size(); ++t) {
            boards_[t].clear();
            for (const CellShape& shape : taken_[t]) boards_[t].take(shape, 0, 0);
        }
        std::vector<CellSpot> spots(islands_.size());
        CellSpot from;
        double area = std::numeric_limits<double>::infinity();
        for (; failed_ < order.size(); ++failed_) {
            const std::size_t k = order[failed_];
            if (islands_[k].area < tolerance::similar_area * area) {
                area = islands_[k].area;
                from = {};
            }
            if (!place(k, rule, from, spots[k])) {
                room_ = static_cast<double>(taken) / static_cast<double>(cells);
                return false;
            }
            taken += drawn_[k][0].shape.cells();
            // Tiles and rows before are full for the next island.
            from = spots[k];
            if (!is_many_) from.y = std::max(0, from.y - drawn_[k][0].shape.height / 2);
        }
        best_scale_ = scale;
        spots_ = std::move(spots);
        return true;
    }

    /// @param from tile and row before which no room is looked for
    bool place(std::size_t k, Rule rule, const CellSpot& from, CellSpot& spot)
    {
        for (spot.tile = from.tile; spot.tile < boards_.size(); ++spot.tile)
            if (place_on_tile(k, rule, spot.tile == from.tile ? from.y : 0, spot)) return true;
        return false;
    }

    bool place_on_tile(std::size_t k, Rule rule, int from, CellSpot& spot)
    {
        CellBoard& board = boards_[spot.tile];
        const DrawnTurns& turns = drawn_[k];
        std::array<int, 3> best = {INT_MAX, 0, 0};
        const int tried =
            (islands_.size() == 1 && is_free_) || (is_held_ && alike_[k]) ? 1 : 4;  // one alone stands upright
        for (int t = 0; t < tried; ++t) {
            const CellShape& shape = turns[t].shape;
            for (int y = from; y + shape.height <= side_; ++y) {
                const int top = y + shape.height;
                if ((rule == Rule::lowest ? y : top) > best[0]) break;
                const int x = board.first_room(shape, turns[t].order, y, 0);
                if (x < 0) continue;
                const int right = x + shape.width;
                std::array<int, 3> score = {top, right, t};
                if (rule == Rule::lowest) score = {y, right, t};
                if (rule == Rule::smallest_square) score = {std::max(top, right), top + right, t};
                if (score < best) {
                    best = score;
                    spot = {t, x, y, spot.tile};
                }
                if (rule != Rule::smallest_square) break;
            }
        }
        if (best[0] == INT_MAX) return false;
        board.take(turns[spot.turn].shape, spot.x, spot.y);
        return true;
    }

    TilePacking result()
    {
        const std::vector<DrawnTurns> drawn = draw_islands(islands_, best_scale_, unit_, margin_);
        if (!is_many_ && is_free_) {  // the other poses do not know what else lies on the board
            std::vector<std::vector<CellMask>> masks(islands_.size());
            std::vector<IslandSpot> spots;
            std::vector<std::array<double, 4>> preference;
            for (std::size_t k = 0; k < islands_.size(); ++k) {
                for (const DrawnTurn& turn : drawn[k]) masks[k].emplace_back(turn.shape);
                spots.push_back({spots_[k].turn, spots_[k].x, spots_[k].y});
                preference.push_back(upright_by_turn(islands_[k]));
            }
            turn_to_preferred_poses(masks, preference, side_, spots);
            for (std::size_t k = 0; k < spots.size(); ++k) spots_[k] = {spots[k].pose, spots[k].x, spots[k].y};
        }
        TilePacking packing{{{}, best_scale_, margin_}, {}};
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            packing.places.push_back(place_of_spot(islands_[k], drawn[k], spots_[k], unit_, best_scale_));
            packing.tile.push_back(static_cast<int>(spots_[k].tile));
        }
        return packing;
    }

    const int side_;     // cells
    const double unit_;  // grid units
    const double margin_;
    const bool is_many_;
    const PackingTime& time_;
    const double most_scale_;
    std::vector<std::vector<CellShape>> taken_;  // on the board of each tile
    bool is_free_ = true;                        // one tile, with nothing on it
    std::vector<UprightIsland> islands_;
    std::vector<char> alike_;
    bool is_held_ = false;           // islands that are alike keep their turn
    std::vector<CellBoard> boards_;  // of the tiles
    std::int64_t allowed_ = 0;       // work
    std::vector<DrawnTurns> drawn_;
    double drawn_scale_ = 0.0, best_scale_ = 0.0;
    std::vector<CellSpot> spots_;  // at the best scale
    std::size_t failed_ = 0;       // place in the order of the island that found no room
    double room_ = 0.0;            // share of the islands' cells that found room, or at most would
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
void tighten(const std::vector<Outline>& outlines, const PackingTime& time, IslandPacking& best)
{
    std::int64_t points = 0;
    for (const Outline& outline : outlines) points += outline.points.rows();
    const std::int64_t words = std::clamp(words_a_point * points, fewest_words, most_words);
    std::uint64_t seed = 0;
    const IslandPacking first = best;
    const auto attempt = [&](IslandTurns turns, double gain, std::int64_t most) {
        if (time.is_over && time.is_over()) return;
        TightSearch search{turns, most, seed};
        if (seed == 0) search.from = &first;
        if (IslandPacking tight = pack_tightly(outlines, best.margin, search, time); tight.scale > gain * best.scale)
            best = std::move(tight);
    };
    const bool is_held = outlines.size() <= few_islands || longest_side(outlines, best.scale) > held;
    attempt(IslandTurns::quarter, 1.0, is_held ? words / 2 : words);
    if (std::ranges::any_of(outlines, &Outline::alike)) attempt(IslandTurns::alike, worth_one_turn, words);
    if (is_held) attempt(IslandTurns::free, worth_leaning, words / 2);
    // Other arrangements at random, each with more work, while there is time.
    while (time.is_used_up && !time.is_over()) {
        ++seed;
        attempt(IslandTurns::quarter, 1.0, words + static_cast<std::int64_t>(seed) * words / 2);
    }
}

}  // namespace

TilePacking pack_around(const std::vector<Outline>& outlines, double margin, const PackingSite& site,
                        const PackingTime& time)
{
    if (outlines.empty()) return {{{}, 1.0, margin}, {}};
    require_finite_outlines(outlines);
    std::size_t count = outlines.size();
    for (const std::vector<Outline>& taken : site.taken) count += taken.size();
    margin = std::min(margin, most_margin(count / site.taken.size()));
    return Packer(outlines, margin, time, site).pack();
}

IslandPacking pack_islands(const std::vector<Outline>& outlines, double margin, const PackingTime& time)
{
    if (outlines.empty()) return {{}, 1.0, margin};
    require_finite_outlines(outlines);
    margin = std::min(margin, most_margin(outlines.size()));
    if (outlines.size() >= islands_on_shelves) return pack_on_shelves(outlines, margin);
    IslandPacking best = Packer(outlines, margin, time).pack();
    if (outlines.size() <= most_tight) tighten(outlines, time, best);
    return best;
}

}  // namespace koebe
