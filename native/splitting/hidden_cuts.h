// Cuts moved to where they are less seen.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// Cuts each border between two parts anew: the minimum cut within a band round it, edges in hollows counting as
/// shorter and those on ridges as longer. Kept where the parts stay as many, with as many loops each, and cost no more
/// than before but for a small share of a part's price. @param parts each with a map of its own
void hide_cuts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
               ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
