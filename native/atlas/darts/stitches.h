// Stitches: parts joined again along stretches of their borders, as a person leaves a trunk in one piece with its
// limbs.
#pragma once

#include "cost/costs.h"
#include "darts/dart_rounds.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// Joins parts along stretches of their borders, the most promising first. A stretch lies where the cut is most seen
/// and where its two sides fit together in the plane: the sides of two parts, or of a slit in one. The joined part is
/// relaxed, and stays if the cut and the island that it saves cost more than the energy and the compactness that it
/// loses. On a surface that is its own mirror image both stretches are joined, or none. Flat parts stay.
/// @param parts relaxed for this E, with free loops @return whether any parts were joined
bool stitch_parts(std::vector<HeldPart>& parts, double even, const ThroughPrice& price, ExecutionContext& context);

}  // namespace koebe
