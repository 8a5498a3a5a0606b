// Makes flat parts more even, each by itself, between conformal and true to size.
#pragma once

#include "core/map_options.h"
#include "execution/execution.h"
#include "flat/flat_part.h"

#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

namespace koebe {

struct EvenOptions {
    std::optional<double> even;        ///< E; without a value: an E that does not raise the mean angle error
    LoopForm loops = LoopForm::round;  ///< round: held vertices stay on the circles and lines of their rims
    double darts = 0.0;                ///< from 0 (no darts) to 1 (many)
    double piece = 1.0;                ///< price of one more part, as the length of a cut
    bool roomy = true;                 ///< parts are also cut so that they can be packed more densely
    int threads = 0;
    int rounds = 20;      ///< as EvenEffort::most_rounds, in the search for E and cuts
    double dearer = 1.0;  ///< factor of the price of cuts, except those made for packing
    bool stitch = false;  ///< parts are joined again along stretches of borders (stitches.h)
};

struct EvenParts {
    double even = 0.0;                    ///< the E of the parts
    std::vector<std::size_t> left;        ///< parts that stay as they were, although E is not 0
    std::vector<std::size_t> worse = {};  ///< groups whose angles are too much worse than at E = 0
};

/// How large the angle errors of parts may be, together.
struct AngleBounds {
    std::vector<std::size_t> group;           ///< (parts) of parts that were one part before they were cut
    std::vector<double> most;                 ///< (groups) sum of angle errors at E = 0; empty: no bounds
    std::function<AngleBounds()> exact = {};  ///< these were measured roughly, and this measures well

    double sum() const { return std::accumulate(most.begin(), most.end(), 0.0); }
};

/// Relaxes all parts (even/even_map.h). Cuts darts into them (dart_rounds.h), unless E is 0. If loops are free, it also
/// cuts parts through (through_rounds.h): first it joins loops, then it splits parts that darts did not help, and last
/// it joins parts where that pays (stitches.h) and cuts for room (roomy_cuts.h). The pieces of a part come last, or
/// after it. A part that is not one to one is not changed.
EvenParts make_parts_even(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context);

/// Relaxes parts that were decided on a coarse surface. Takes a smaller E if angles are worse than the bounds allow, as
/// a sum, unless few groups make them so: these are named, to be replaced by what they are at E = 0.
/// @param even their E on the coarse surface @return E; 0: all groups are worse
EvenParts relax_carried(std::vector<FlatPart>& flats, double even, AngleBounds bounds, const EvenOptions& options,
                        ExecutionContext& context);

/// The cost of parts once they are even: their energy at this E, or at the E of parts with darts if none is given. To
/// it come their boundary, half of which is a cut's or the surface's own, and one more part each, at the price of
/// darts.
double cost_when_even(std::vector<FlatPart> parts, const EvenOptions& options, ExecutionContext& context);

}  // namespace koebe
