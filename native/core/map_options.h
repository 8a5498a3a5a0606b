// The options of every map, and of every map that iterates. options/options.json describes them to users; the defaults
// agree with it (tests/python/test_option_table.py).
#pragma once

namespace koebe {

/// How loops move when a map is made more even: `round` keeps each on a circle or a straight end. `automatic` is free
/// in parts, where round loops cost long cuts, and round elsewhere.
enum class LoopForm { automatic, round, free };

struct MapOptions {
    double most_lost = 0.01;  ///< share of the surface's area that may be lost when stored (quality/take_verdict.h)

    /// Calls visit(name, pointer to member) for each option. All option structs have such a function: the command's
    /// flags, the reports and the Python binding are made of it.
    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("most_lost", &MapOptions::most_lost);
    }
};

struct SweepOptions : MapOptions {
    double tolerance = 1e-6;  ///< on the change of the map in a sweep; for circles in units of the unit disk
    int max_sweeps = 50;

    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("tolerance", &SweepOptions::tolerance);
        visit("max_sweeps", &SweepOptions::max_sweeps);
        MapOptions::each_option(visit);
    }
};

}  // namespace koebe
