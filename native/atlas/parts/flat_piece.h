// A piece of a mesh, cut into parts that lie flat.
#pragma once

#include "execution/execution.h"
#include "flat/flat_part.h"
#include "flat/flat_parts.h"
#include "parts/even_parts.h"
#include "parts/parts.h"
#include "splitting/piece_surface.h"

#include <vector>

namespace koebe {

/// Whether rims of parts may have any form: E is not 0, and none of round loops, round cuts, slits is asked for.
bool rims_are_free(const PartsOptions& options);

EvenOptions evening_of(const PartsOptions& options, bool roomy, int threads);

/// The parts of a piece, flat. They name faces and vertices by the numbers of the piece.
FlatParts flat_piece(const PieceInput& input, PieceSurface surface, const PartsOptions& options, int threads,
                     ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
