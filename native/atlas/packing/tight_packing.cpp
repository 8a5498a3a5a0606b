#include "packing/tight_packing.h"

#include "packing/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace koebe {
namespace {

constexpr int coarse_side = 192;     // cells of the square at first, where islands cover
constexpr double first_share = 0.5;  // that share of it
constexpr int refinement = 4;        // fine cells along a coarse one, twice
constexpr int first_squeeze = 100, second_squeeze = 500;
constexpr int most_larger = 20;        // squares that are tried until the islands have room
constexpr int most_failed_moves = 40;  // disturbed arrangements in a row
constexpr double coarse_share = 0.8;   // of the work
constexpr int angles = 64;             // turns between 0 and 90 degrees, to find the smallest square round an island
constexpr int angles_apart = 16;       // of these every sixteenth is a pose

/// A turn of k/angles of 90 degrees, nearly: of absolute value 1, without sines.
Complex turn_of(int k)
{
    const double t = static_cast<double>(k) / angles;
    return {(1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)};
}

/// The island in each of its angles: upright, and if turns are free in others too, also in the smallest square.
std::vector<UprightIsland> angles_of(const Outline& outline, IslandTurns turns)
{
    std::vector<UprightIsland> found{upright_island(outline)};
    if (turns == IslandTurns::alike && outline.alike) found[0] = most_upright(found[0]);
    if (turns != IslandTurns::free || outline.along_axes) return found;
    int smallest = 0;
    double least = found[0].extent;
    for (int k = 1; k < angles; ++k)
        if (const double extent = turned_island(found[0], turn_of(k)).extent; extent < least) {
            least = extent;
            smallest = k;
        }
    for (int k = 1; k < angles; ++k)
        if (k % angles_apart == 0 || k == smallest) found.push_back(turned_island(found[0], turn_of(k)));
    return found;
}

/// Islands drawn at one size, in all their poses: four quarter turns of each angle.
struct Drawn {
    std::vector<std::vector<CellMask>> masks;
    std::vector<std::vector<GridPoint>> origins;
};

class TightPacker {
public:
    TightPacker(const std::vector<Outline>& outlines, double margin, const TightSearch& search, const PackingTime& time)
        : margin_(margin), seed_(search.seed), from_(search.from), outlines_(outlines), time_(time)
    {
        const IslandTurns turns = search.turns;
        for (const Outline& outline : outlines) {
            held_.push_back(turns == IslandTurns::alike && outline.alike);
            islands_.push_back(angles_of(outline, turns));
            area_ += islands_.back().front().area;
        }
    }

    IslandPacking pack(std::int64_t most)
    {
        if (!(area_ > 0.0)) return {{}, 0.0, margin_};
        side_ = coarse_side;
        scale_ = std::sqrt(first_share / area_) * side_ * static_cast<double>(grid_cell);
        if (!is_drawable() || !pack_coarsely(static_cast<std::int64_t>(coarse_share * static_cast<double>(most))))
            return {{}, 0.0, margin_};
        if (!refine(most, first_squeeze) || !refine(most, second_squeeze)) return {{}, 0.0, margin_};
        return result();
    }

private:
    /// Whether no island is much larger than the square.
    bool is_drawable() const
    {
        const double longest = static_cast<double>(4 * coarse_side * grid_cell);
        return std::ranges::none_of(islands_, [&](const auto& angles) { return angles[0].extent * scale_ > longest; });
    }

    /// @param largest square in which the islands keep the margin
    Drawn draw(int largest) const
    {
        const auto reach = static_cast<std::int64_t>(std::ceil(0.5 * margin_ * largest * grid_cell)) + 1;
        Drawn drawn;
        for (std::size_t i = 0; i < islands_.size(); ++i) {
            drawn.masks.emplace_back();
            drawn.origins.emplace_back();
            for (const UprightIsland& island : islands_[i])
                for (const DrawnTurn& turn : draw_island(island, scale_, reach)) {
                    drawn.masks.back().emplace_back(turn.shape);
                    drawn.origins.back().push_back(turn.shape.origin);
                    if (held_[i]) break;
                }
        }
        return drawn;
    }

    /// The same arrangement in a smaller square.
    std::vector<IslandSpot> squeezed(int side) const
    {
        std::vector<IslandSpot> spots = spots_;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            const CellMask& mask = drawn_.masks[i][static_cast<std::size_t>(spots[i].pose)];
            const auto squeeze = [&](int& at, int length) {
                if (side_ > length) at = at * std::max(0, side - length) / (side_ - length);
            };
            squeeze(spots[i].x, mask.width());
            squeeze(spots[i].y, mask.height());
        }
        return spots;
    }

    bool pack_coarsely(std::int64_t most)
    {
        // Start: random places, or those of an earlier packing.
        drawn_ = draw(side_);
        Separation separation(drawn_.masks);
        for (std::uint64_t k = 0; k < seed_ * islands_.size(); ++k) separation.random();
        spots_.resize(islands_.size());
        for (IslandSpot& spot : spots_)
            spot = {0, static_cast<int>(separation.random() % coarse_side),
                    static_cast<int>(separation.random() % coarse_side)};
        if (from_) begin_with(*from_);
        // A board on which they come apart at all.
        for (int k = 0; !separation.separate(side_, spots_, false, most); side_ += side_ / 20)
            if (++k == most_larger || separation.work() > most || is_over()) return false;
        // Smaller boards: the step is halved after failures, then islands are shaken.
        int step = side_ / 32;
        for (int failures = 0; failures < most_failed_moves && separation.work() < most && !is_over();) {
            std::vector<IslandSpot> spots = squeezed(side_ - step);
            if (failures > 0) disturb(spots, separation);
            if (separation.separate(side_ - step, spots, false, most)) {
                take(side_ - step, std::move(spots));
                failures = 0;
            } else if (step > 1) {
                step /= 2;
            } else {
                ++failures;
            }
        }
        return true;
    }

    /// The arrangement of a packing, rounded to cells.
    void begin_with(const IslandPacking& packing)
    {
        const double unit = scale_ / packing.scale;
        side_ = static_cast<int>(std::ceil(unit / static_cast<double>(grid_cell)));
        for (std::size_t i = 0; i < spots_.size(); ++i) {
            const UprightIsland& island = islands_[i].front();
            const Complex turn = packing.places[i].turn / island.turn;
            const int pose = std::abs(turn.real()) > std::abs(turn.imag()) ? (turn.real() > 0.0 ? 0 : 2)
                                                                           : (turn.imag() > 0.0 ? 1 : 3);
            spots_[i].pose = held_[i] ? 0 : pose;
            const PlanarPoints at = place_island(outlines_[i].points, packing.places[i], packing.scale);
            const Eigen::RowVector2d corner = (at.colwise().minCoeff().array() - 0.5 * margin_) * unit;
            spots_[i].x = static_cast<int>(corner[0] / static_cast<double>(grid_cell));
            spots_[i].y = static_cast<int>(corner[1] / static_cast<double>(grid_cell));
        }
    }

    bool is_over() const { return time_.is_over && time_.is_over(); }

    /// One or two pairs of islands change places.
    static void disturb(std::vector<IslandSpot>& spots, Separation& separation)
    {
        for (std::uint64_t k = separation.random() % 2; k < 2; ++k) {
            IslandSpot& a = spots[separation.random() % spots.size()];
            IslandSpot& b = spots[separation.random() % spots.size()];
            std::swap(a.x, b.x);
            std::swap(a.y, b.y);
        }
    }

    void take(int side, std::vector<IslandSpot> spots)
    {
        side_ = side;
        spots_ = std::move(spots);
    }

    /// The arrangement on a finer board: each island in its pose.
    void draw_finely()
    {
        const Drawn coarse = std::move(drawn_);
        scale_ *= refinement;
        side_ *= refinement;
        for (std::size_t i = 0; i < islands_.size(); ++i)
            islands_[i] = {islands_[i][static_cast<std::size_t>(spots_[i].pose / 4)]};
        drawn_ = draw(side_ + 2 * most_larger);
        for (std::size_t i = 0; i < islands_.size(); ++i) {
            const GridPoint& before = coarse.origins[i][static_cast<std::size_t>(spots_[i].pose)];
            IslandSpot& spot = spots_[i];
            spot.pose %= 4;
            const GridPoint& origin = drawn_.origins[i][static_cast<std::size_t>(spot.pose)];
            const auto finer = [&](int at, int k) {
                const std::int64_t from = (at * grid_cell - before[k]) * refinement + origin[k] + grid_cell / 2;
                return static_cast<int>(std::max<std::int64_t>(from, 0) / grid_cell);
            };
            spot.x = finer(spot.x, 0);
            spot.y = finer(spot.y, 1);
        }
    }

    /// On a finer board. @param parts of the square's side, by which it becomes smaller at first
    bool refine(std::int64_t most, int parts)
    {
        draw_finely();
        const auto work = static_cast<std::int64_t>((1.0 - coarse_share) * static_cast<double>(most));
        Separation separation(drawn_.masks);
        for (int k = 0; !separation.separate(side_, spots_, true, work); side_ += 2)
            if (++k == most_larger) return false;
        for (int step = side_ / parts; step > 0 && separation.work() < work && !is_over();) {
            std::vector<IslandSpot> spots = squeezed(side_ - step);
            if (separation.separate(side_ - step, spots, true, work))
                take(side_ - step, std::move(spots));
            else
                step /= 2;
        }
        return true;
    }

    IslandPacking result()
    {
        std::vector<std::array<double, 4>> preference;
        for (const auto& angles : islands_) preference.push_back(upright_by_turn(angles.front()));
        turn_to_preferred_poses(drawn_.masks, preference, side_, spots_);
        const double unit = static_cast<double>(side_) * grid_cell;
        IslandPacking packing{{}, scale_ / unit, margin_};
        for (std::size_t i = 0; i < islands_.size(); ++i) {
            DrawnTurns turns;
            turns[static_cast<std::size_t>(spots_[i].pose)].shape.origin =
                drawn_.origins[i][static_cast<std::size_t>(spots_[i].pose)];
            const CellSpot spot = {spots_[i].pose, spots_[i].x, spots_[i].y};
            packing.places.push_back(place_of_spot(islands_[i].front(), turns, spot, unit, packing.scale));
        }
        return packing;
    }

    const double margin_;
    const std::uint64_t seed_;
    const IslandPacking* from_;
    const std::vector<Outline>& outlines_;
    const PackingTime& time_;
    std::vector<std::vector<UprightIsland>> islands_;  // in all their angles
    std::vector<char> held_;                           // 1: the island keeps its turn
    double area_ = 0.0, scale_ = 0.0;                  // grid units of a unit of the points
    int side_ = 0;                                     // of the square, in cells
    Drawn drawn_;
    std::vector<IslandSpot> spots_;
};

}  // namespace

IslandPacking pack_tightly(const std::vector<Outline>& outlines, double margin, const TightSearch& search,
                           const PackingTime& time)
{
    return TightPacker(outlines, margin, search, time).pack(search.most);
}

}  // namespace koebe
