// Renumbers the loops in a disk map's warnings, for a map with the same loops in another order.
#pragma once

#include "pipeline/result.h"

#include <initializer_list>
#include <vector>

namespace koebe {

/// @param order the other map's loops @param left_out kinds of warnings that the other map gives itself
std::vector<Warning> with_loops_renumbered(const UniformizeResult& disk, const std::vector<const LoopReport*>& order,
                                           std::initializer_list<WarningKind> left_out);

}  // namespace koebe
