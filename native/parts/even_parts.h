// Flat parts made more even, each by itself, between conformal and true to size.
#pragma once

#include "core/map_options.h"
#include "execution/execution.h"
#include "parts/flat_part.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace koebe {

struct EvenParts {
    double even = 0.0;              ///< E
    std::vector<std::size_t> left;  ///< parts that stay as they were, though asked for
};

/// Relaxes all parts (relax/even_map.h); one that is not one to one as it lies stays as it is.
/// @param even E; none: the largest of some at which the mean angle error is no worse than that of the flat parts
/// @param loops whether vertices that are held stay on the circles and lines of their rims
EvenParts make_parts_even(std::vector<FlatPart>& flats, std::optional<double> even, LoopForm loops, int threads,
                          ExecutionContext& context);

}  // namespace koebe
