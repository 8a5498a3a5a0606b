// The order in which a sweep of the Koebe iteration opens the loops (paper, section 4.4).
#pragma once

#include "iteration/iteration_options.h"

#include <vector>

namespace koebe {

/// The loops that one step opens: two, with the conventional method one.
using OpenedLoops = std::vector<int>;

/// The steps of one sweep. They open each loop at least once.
using Sweep = std::vector<OpenedLoops>;

/// Whether a loop keeps its partner (gk). Changing partners, as in Fig. 4, end in a cycle of maps that differ by the
/// discretization, not in one map.
enum class Partners { fixed, changing };

/// The sweep that is repeated. gk: disjoint pairs (0,1), (2,3), ..., and (0, last) for an odd number. ck: each loop.
/// against_outer: (0,k) for each k > 0.
Sweep fixed_sweep(int loop_count, Method method);

/// A round of sweeps in which every loop has every other as its partner: n - 1 sweeps of n / 2 pairs for n loops, by
/// the circle method of tournaments. With an odd number the loop left over in a sweep is paired with loop 0, and loop 0
/// with 1.
std::vector<Sweep> round_of_changing_pairs(int loop_count);

/// @throws InputError a step names a loop that does not exist, or the same loop twice; no step opens some loop; a step
/// opens two loops with the conventional method, or one loop with another method, or with two loops; against_outer
/// without loop 0
void require_schedule(const Sweep& schedule, int loop_count, Method method);

}  // namespace koebe
