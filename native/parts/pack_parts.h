// Flat parts packed into the unit square.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"

#include <optional>
#include <vector>

namespace koebe {

/// A scale that all parts get, in place of the largest scale at which they fit.
struct WantedScale {
    double scale = 1.0;    ///< sides of the square per unit of the points
    double density = 1.0;  ///< texel density at this scale, for messages
};

struct PackedParts {
    std::vector<PlanarPoints> places;  ///< of each part, its points (V, 2) in [0, 1]^2
    std::vector<char> anew;            ///< 1: the part overlapped itself after packing, and was drawn anew, less even
};

/// Packs parts into the unit square, then turns flipped faces back there. If such a repair changes an outline, all
/// parts are packed again. In the last round a repair may not change an outline.
/// @param flats their kinds and points may change
/// @param wanted if given, the parts lie together at the corner of the square
/// @throws InputError the parts do not fit at the wanted scale; SolverError, Cancelled
PackedParts pack_parts(std::vector<FlatPart>& flats, int threads, ExecutionContext& context,
                       const std::optional<WantedScale>& wanted = {});

}  // namespace koebe
