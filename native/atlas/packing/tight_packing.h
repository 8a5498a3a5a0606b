// A packing of few islands made tighter.
#pragma once

#include "packing/packed_island.h"
#include "packing/packing.h"

#include <cstdint>
#include <vector>

namespace koebe {

/// Turns that islands get.
enum class IslandTurns {
    alike,    ///< as quarter, but islands that are alike lie in one turn
    quarter,  ///< by 90 degrees: islands stay upright
    free      ///< by more angles, except islands that lie along the axes already
};

struct TightSearch {
    IslandTurns turns = IslandTurns::quarter;
    std::int64_t most = 0;                ///< work, in words compared
    std::uint64_t seed = 0;               ///< of the arrangement at first,
    const IslandPacking* from = nullptr;  ///< unless it is that of a packing by quarter turns
};

/// Packs islands by moving them apart in a square that becomes smaller and smaller: first on a coarse board, anywhere
/// and in any turn (`separation.h`); then on finer boards, along short ways.
/// @return a scale of 0 if it found no packing
IslandPacking pack_tightly(const std::vector<Outline>& outlines, double margin, const TightSearch& search,
                           const PackingTime& time = {});

}  // namespace koebe
