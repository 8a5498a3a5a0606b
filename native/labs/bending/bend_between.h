// Bends a circle domain until its circles are given ones, on the best of several paths.
#pragma once

#include "bending/circle_bending.h"

#include <vector>

namespace koebe {

/// Takes the circles along the paths between them (paths_between), until one of them arrives. If none does, the result
/// is of the path that came farthest.
/// @param from, to circles of the loops @throws Cancelled
BendingResult bend_between(const BendingInput& input, const std::vector<Circle>& from, const std::vector<Circle>& to,
                           const Extremal& extremal, ExecutionContext& context);

}  // namespace koebe
