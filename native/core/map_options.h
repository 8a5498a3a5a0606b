// The options that all maps have, and those of all that iterate. Users read of them what options/options.json says,
// whose defaults these are (tests/python/test_option_table.py).
#pragma once

namespace koebe {

/// Of a map that is made more even: round loops stay on circles and straight ends, which move.
enum class LoopForm { round, free };

struct MapOptions {
    double most_lost = 0.01;  ///< share of the surface's area that may be lost as stored (quality/take_verdict.h)

    /// Calls visit(name, pointer to member) for each, as all the options' structs do: flags of the command, reports and
    /// the binding are made of it.
    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("most_lost", &MapOptions::most_lost);
    }
};

struct SweepOptions : MapOptions {
    double tolerance = 1e-6;  ///< on what the map says of its change in a sweep: of the circles, in the unit disk
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
