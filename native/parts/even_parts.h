// Flat parts made more even, each by itself, between conformal and true to size.
#pragma once

#include "core/map_options.h"
#include "execution/execution.h"
#include "parts/flat_part.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace koebe {

struct EvenOptions {
    std::optional<double> even;  ///< E; none: one at which the mean angle error is no worse than that of the flat parts
    LoopForm loops = LoopForm::round;  ///< whether vertices that are held stay on the circles and lines of their rims
    double darts = 0.0;                ///< from 0, none, to 1, many
    int threads = 0;
};

struct EvenParts {
    double even = 0.0;              ///< E
    std::vector<std::size_t> left;  ///< parts that stay as they were, though asked for
};

/// Relaxes all parts (relax/even_map.h), and cuts darts into them (dart_rounds.h) unless E is 0; a part that is not one
/// to one as it lies stays as it is.
EvenParts make_parts_even(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context);

}  // namespace koebe
