// Islands in a square moved until no two overlap.
#pragma once

#include "packing/cell_mask.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace koebe {

/// A place of an island: the number of its pose, and the column and row of its lower left cell.
struct IslandSpot {
    int pose = 0, x = 0, y = 0;
};

/// Moves islands until no two overlap, one island after the other to the place where it overlaps least. Pairs that go
/// on overlapping weigh more (guided local search: Egeblad, Nielsen and Odgaard 2007; Gardeyn and Wauters 2025). All
/// decisions are on integers.
class Separation {
public:
    /// @param poses of each island: its masks, in one or more turns
    explicit Separation(std::vector<std::vector<CellMask>> poses);

    /// Searches places without overlap. @return whether it found such places
    /// @param side of the square, in cells @param spots where the islands begin, and where they end if it succeeds
    /// @param is_local islands keep their pose, and move only along short ways @param most limit of work()
    bool separate(int side, std::vector<IslandSpot>& spots, bool is_local, std::int64_t most);

    std::int64_t work() const { return work_; }  ///< words compared so far
    std::uint64_t random();

private:
    struct Choice {
        IslandSpot spot;
        std::int64_t cost = 0;
    };

    const CellMask& mask(std::size_t i, const IslandSpot& spot) const
    {
        return poses_[i][static_cast<std::size_t>(spot.pose)];
    }
    std::int64_t& weight(std::size_t i, std::size_t j) { return weights_[i * poses_.size() + j]; }
    std::int64_t& overlap(std::size_t i, std::size_t j) { return overlaps_[i * poses_.size() + j]; }
    std::int64_t cost(std::size_t i, const IslandSpot& spot, std::int64_t bound);
    bool clamp(std::size_t i, IslandSpot& spot) const;
    Choice descend(std::size_t i, Choice from, int step);
    bool sample(std::size_t i, bool is_near, IslandSpot& spot);
    Choice best_place(std::size_t i, bool is_local);
    void move(std::size_t i, const IslandSpot& spot);
    std::int64_t total() const;
    void reweigh();

    std::vector<std::vector<CellMask>> poses_;
    std::vector<IslandSpot> spots_;
    std::vector<std::int64_t> weights_, overlaps_;  // of pairs; a weight of 1 is 1024
    int side_ = 0;
    std::int64_t work_ = 0;
    std::uint64_t random_ = 1;
};

/// Turns islands to poses that are preferred, where such a pose has room in the place of the island as it lies.
/// @param poses as for Separation, four of each island, or one @param preference of its poses
/// @param spots without overlap, changed in place
void turn_to_preferred_poses(const std::vector<std::vector<CellMask>>& poses,
                             const std::vector<std::array<double, 4>>& preference, int side,
                             std::vector<IslandSpot>& spots);

}  // namespace koebe
