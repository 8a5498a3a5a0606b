// The options of every map, of every map that iterates, and of groups of maps. options/options.json describes them to
// users; the defaults agree with it (tests/python/test_option_table.py).
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// How loops move when a map is made more even: `round` keeps each on a circle or a straight end. `automatic` is free
/// in parts, where round loops cost long cuts, and round elsewhere.
enum class LoopForm { automatic, round, free };

struct MapOptions {
    double most_lost = 0.01;  ///< share of the surface's area that may be lost when stored (quality/take_verdict.h)
};

struct SweepOptions : MapOptions {
    double tolerance = 1e-6;  ///< on the change of the map in a sweep; for circles in units of the unit disk
    int max_sweeps = 50;
};

/// Of a map to a domain whose UVs are cut along edges.
struct CutDomainOptions : SweepOptions {
    std::vector<Index> polygon = {};  ///< (F) faces of one number are not cut apart; empty: each face by itself
};

/// Of a map that can be made more even.
struct EvennessOptions {
    double even = 0.0;                     ///< 0: conformal, 1: true to size (even/even_map.h)
    LoopForm loops = LoopForm::automatic;  ///< with `even`
};

}  // namespace koebe
