// Cuts that let parts be packed more densely: they take branches off, and shorten long strips.
#pragma once

#include "cost/costs.h"
#include "darts/through_cuts.h"

#include <vector>

namespace koebe {

/// About the area of the square into which parts can be packed: that of their convex hulls, or least_square.
double square_for_all(const std::vector<const FlatPart*>& parts);

/// A few cuts of a part whose two pieces need less room, first the cut worth most of its cost. A part needs the area of
/// its convex hull, and as much as the smallest square round it is larger than the square for all parts. The `forecast`
/// of a cut is the area that it saves, in energy: a square as large as the surface is worth 0.005. The pieces keep
/// their map.
/// @param square area of the square for all parts, in areas of the surface @param price its `piece` must have a value
std::vector<ThroughCut> roomy_cuts(const FlatPart& flat, double square, const ThroughPrice& price);

}  // namespace koebe
