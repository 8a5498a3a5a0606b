// Flat parts packed into the unit square.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"

#include <vector>

namespace koebe {

struct PackedParts {
    std::vector<PlanarPoints> places;  ///< of each part, its points (V, 2) in [0, 1]^2
    std::vector<char> anew;            ///< 1: the part overlapped itself there, and was drawn anew, less even
};

/// Packs parts into the unit square, then turns flipped faces back there. If that changes an outline, all parts are
/// packed again. In the last round a repair may not change an outline.
/// @param flats their kinds and points may change
/// @throws SolverError, Cancelled
PackedParts pack_parts(std::vector<FlatPart>& flats, int threads, ExecutionContext& context);

}  // namespace koebe
