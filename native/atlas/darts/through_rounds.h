// Cuts relaxed parts through, as long as cuts pay.
#pragma once

#include "cost/costs.h"
#include "darts/dart_rounds.h"
#include "darts/through_cuts.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// Cuts each part by its best through cuts (through_cuts.h), relaxes the pieces, and goes on with them. A cut stays if
/// the faces nearest to it released more energy than it costs. On a surface that is its own mirror image cuts come in
/// pairs: either both cuts are made, or neither. Parts with round loops are not cut.
/// @param parts relaxed for this E; new parts come last
/// @return whether any cut was made
bool cut_parts_through(std::vector<HeldPart>& parts, double even, const ThroughPrice& price, int threads,
                       ExecutionContext& context);

/// Cuts parts into pieces that can be packed more densely (roomy_cuts.h), as long as a cut saves more room than it
/// costs. The pieces keep their map. Mirror images are cut alike. Parts with round loops are not cut.
/// @param price its `piece` must have a value @return whether any cut was made
bool cut_parts_for_room(std::vector<HeldPart>& parts, const ThroughPrice& price, int threads,
                        ExecutionContext& context);

}  // namespace koebe
