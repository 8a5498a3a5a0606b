#include "packing/separation.h"

#include "core/numbering.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr std::int64_t unit_weight = 1024;
constexpr std::int64_t heaviest = unit_weight << 20;
constexpr int samples_anywhere = 24, samples_near = 8;  // of an island's places,
constexpr int patience = 60;                            // and rounds without less overlap before it gives up
constexpr int local_step = 8;                           // cells
constexpr double clearly_preferred = 1e-6;              // beyond rounding

}  // namespace

Separation::Separation(std::vector<std::vector<CellMask>> poses)
    : poses_(std::move(poses)),
      weights_(poses_.size() * poses_.size(), unit_weight),
      overlaps_(poses_.size() * poses_.size(), 0)
{
}

std::uint64_t Separation::random()
{
    random_ = random_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return random_ >> 33;
}

/// Moves a place into the square; false: the island is too large for it.
bool Separation::clamp(std::size_t i, IslandSpot& spot) const
{
    const CellMask& own = mask(i, spot);
    if (own.width() > side_ || own.height() > side_) return false;
    spot.x = std::clamp(spot.x, 0, side_ - own.width());
    spot.y = std::clamp(spot.y, 0, side_ - own.height());
    return true;
}

/// The weighted overlap of an island with all others, or a number that is at least the bound.
std::int64_t Separation::cost(std::size_t i, const IslandSpot& spot, std::int64_t bound)
{
    const CellMask& own = mask(i, spot);
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < poses_.size() && sum < bound; ++j)
        if (j != i)
            sum += weight(i, j) * own.shared(mask(j, spots_[j]), spots_[j].x - spot.x, spots_[j].y - spot.y, work_);
    work_ += static_cast<std::int64_t>(poses_.size());
    return sum;
}

/// Steps along rows and columns while the overlap falls, and then shorter ones.
Separation::Choice Separation::descend(std::size_t i, Choice from, int step)
{
    constexpr std::array<std::array<int, 2>, 8> ways = {
        {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
    while (step > 0 && from.cost > 0) {
        bool moved = false;
        for (const auto& way : ways) {
            IslandSpot spot = {from.spot.pose, from.spot.x + step * way[0], from.spot.y + step * way[1]};
            clamp(i, spot);
            if (spot.x == from.spot.x && spot.y == from.spot.y) continue;
            const std::int64_t found = cost(i, spot, from.cost);
            if (found >= from.cost) continue;
            from = {spot, found};
            moved = true;
        }
        if (!moved) step /= 2;
    }
    return from;
}

/// A random place in the square, or near the island's place. False: the island is too large for the square in that
/// pose.
bool Separation::sample(std::size_t i, bool is_near, IslandSpot& spot)
{
    spot = spots_[i];
    spot.pose = static_cast<int>(random() % poses_[i].size());
    const CellMask& own = mask(i, spot);
    if (own.width() > side_ || own.height() > side_) return false;
    const auto any = [this](int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); };
    if (is_near) {
        const int reach = side_ / 8;
        spot.x += any(2 * reach + 1) - reach;
        spot.y += any(2 * reach + 1) - reach;
        return clamp(i, spot);
    }
    spot.x = any(side_ - own.width() + 1);
    spot.y = any(side_ - own.height() + 1);
    return true;
}

Separation::Choice Separation::best_place(std::size_t i, bool is_local)
{
    constexpr std::int64_t unknown = std::numeric_limits<std::int64_t>::max();
    const int step = is_local ? local_step : std::max(1, side_ / 32);
    const Choice near = descend(i, {spots_[i], cost(i, spots_[i], unknown)}, step);
    if (is_local || near.cost == 0) return near;
    Choice sampled = {spots_[i], unknown};
    for (int k = 0; k < samples_anywhere + samples_near && sampled.cost > 0; ++k) {
        IslandSpot spot;
        if (!sample(i, k >= samples_anywhere, spot)) continue;
        if (const std::int64_t found = cost(i, spot, sampled.cost); found < sampled.cost) sampled = {spot, found};
    }
    sampled = descend(i, sampled, step);
    return sampled.cost < near.cost ? sampled : near;
}

void Separation::move(std::size_t i, const IslandSpot& spot)
{
    spots_[i] = spot;
    const CellMask& own = mask(i, spot);
    for (std::size_t j = 0; j < poses_.size(); ++j)
        if (j != i)
            overlap(i, j) = overlap(j, i) =
                own.shared(mask(j, spots_[j]), spots_[j].x - spot.x, spots_[j].y - spot.y, work_);
}

std::int64_t Separation::total() const { return std::accumulate(overlaps_.begin(), overlaps_.end(), std::int64_t{0}); }

/// Pairs that overlap weigh 1.2 to 2 times as much, other pairs 0.95 times.
void Separation::reweigh()
{
    const std::int64_t most = *std::ranges::max_element(overlaps_);
    for (std::size_t k = 0; k < weights_.size(); ++k)
        weights_[k] = overlaps_[k] > 0
                          ? std::min(heaviest, weights_[k] * (120 * most + 80 * overlaps_[k]) / (100 * most))
                          : std::max(unit_weight, weights_[k] * 95 / 100);
}

bool Separation::separate(int side, std::vector<IslandSpot>& spots, bool is_local, std::int64_t most)
{
    side_ = side;
    spots_ = spots;
    // Each island in a pose that fits into the square.
    for (std::size_t i = 0; i < poses_.size(); ++i) {
        for (std::size_t k = 0; !clamp(i, spots_[i]); ++k) {
            if (is_local || k == poses_[i].size()) return false;
            spots_[i].pose = static_cast<int>(k);
        }
    }
    std::ranges::fill(weights_, unit_weight);
    for (std::size_t i = 0; i < poses_.size(); ++i) move(i, spots_[i]);
    // Islands that overlap move to where they overlap least, one after the other, by chance. Pairs that still
    // overlap get larger weights.
    std::vector<std::size_t> order = numbers_below<std::size_t>(poses_.size());
    std::int64_t least = total();
    for (int since = 0; least > 0 && since < patience && work_ < most; ++since) {
        for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random() % k]);
        for (const std::size_t i : order) {
            const auto own = overlaps_.begin() + static_cast<std::ptrdiff_t>(i * poses_.size());
            if (std::any_of(own, own + static_cast<std::ptrdiff_t>(poses_.size()),
                            [](auto cells) { return cells > 0; }))
                move(i, best_place(i, is_local).spot);
        }
        const std::int64_t now = total();
        if (now < least - least / 50) since = -1;
        least = std::min(least, now);
        if (now == 0) break;
        reweigh();
    }
    if (total() > 0) return false;
    spots = spots_;
    return true;
}

void turn_to_preferred_poses(const std::vector<std::vector<CellMask>>& poses,
                             const std::vector<std::array<double, 4>>& preference, int side,
                             std::vector<IslandSpot>& spots)
{
    std::int64_t work = 0;
    const auto mask = [&](std::size_t i, int pose) -> const CellMask& {
        return poses[i][static_cast<std::size_t>(pose)];
    };
    const auto has_room = [&](std::size_t i, const IslandSpot& at) {
        const CellMask& own = mask(i, at.pose);
        if (at.x < 0 || at.y < 0 || at.x + own.width() > side || at.y + own.height() > side) return false;
        for (std::size_t j = 0; j < spots.size(); ++j)
            if (j != i && own.shared(mask(j, spots[j].pose), spots[j].x - at.x, spots[j].y - at.y, work) > 0)
                return false;
        return true;
    };
    for (std::size_t i = 0; i < spots.size(); ++i) {
        const auto like = [&](int pose) { return preference[i][static_cast<std::size_t>(pose)]; };
        std::array<int, 4> order = {0, 1, 2, 3};
        std::ranges::stable_sort(order, std::greater<>(), like);
        const IslandSpot now = spots[i];
        for (const int pose : order) {
            if (poses[i].size() == 1 || !(like(pose) > like(now.pose) + clearly_preferred)) break;
            // The pose may lie at any side or corner of the box of the island as it lies, or in its middle.
            const int wide = mask(i, now.pose).width() - mask(i, pose).width();
            const int high = mask(i, now.pose).height() - mask(i, pose).height();
            for (int k = 0; k < 9 && spots[i].pose == now.pose; ++k)
                if (const IslandSpot at = {pose, now.x + k % 3 * wide / 2, now.y + k / 3 * high / 2}; has_room(i, at))
                    spots[i] = at;
            if (spots[i].pose != now.pose) break;
        }
    }
}

}  // namespace koebe
