// Straightens the borders between parts.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// Straightens borders between two parts, one after the other (straight_paths.h). A border stays as it was if the parts
/// and its length, with turns, would cost more, or if a part would lose area or get other loops.
/// @param parts each has a map of its own
void straighten_borders(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                        ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
