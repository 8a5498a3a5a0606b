// The order in which a sweep of the Koebe iteration opens the loops (paper, section 4.4).
#pragma once

#include "iteration/koebe_outcome.h"

#include <utility>
#include <vector>

namespace koebe {

/// The pairs of loops opened in one sweep, each loop in at least one: disjoint ones, (0,1), (2,3), ... for the
/// generalized form, with an odd number (0, last) besides; (0,k) for each k for the conventional one. The same in
/// every sweep: partners that change settle on a cycle of maps that differ by the discretization, not on one map.
std::vector<std::pair<int, int>> sweep_pairs(int loop_count, Method method);

/// The loops that one step opens: two, or with the conventional form of the condensed engine one.
using OpenedLoops = std::vector<int>;

/// A sweep of the condensed engine: steps that take effect together, and after them the next such.
/// @param at_once whether all steps of a sweep take effect together; else each does for itself
std::vector<std::vector<OpenedLoops>> sweep_order(int loop_count, Method method, bool at_once);

}  // namespace koebe
