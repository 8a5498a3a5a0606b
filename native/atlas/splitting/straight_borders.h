// Straightens the borders between parts.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// Straightens the borders between parts, as straight_paths.h does. They stay as they were if a part would be lost, get
/// other loops, lose area, or if the cost would rise by more than a small share of a part's price.
/// @param parts each has a map of its own
void straighten_borders(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                        ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
