// Moves cuts to places where they are seen less.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// Replaces each border between two parts by a minimum cut within a band round it. Edges in hollows count as shorter,
/// and edges on ridges, or where the surface is shown, as longer. A new border stays if the numbers of parts and of
/// their loops stay, and if the cost rises by at most a small share of a part's price. @param parts each has a map of
/// its own
void hide_cuts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
               ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
