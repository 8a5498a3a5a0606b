// Flat parts packed into the unit square.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"

#include <vector>

namespace koebe {

/// Into the unit square, and flips turned back there. Parts whose outline changes by that are packed once more; the
/// last time they stay as they were.
/// @param flats whose kinds and points may change @return (V, 2) of each, in [0, 1]^2
/// @throws SolverError, Cancelled
std::vector<PlanarPoints> pack_parts(std::vector<FlatPart>& flats, int threads, ExecutionContext& context);

}  // namespace koebe
