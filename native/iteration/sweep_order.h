// The order in which a sweep of the Koebe iteration opens the loops (paper, section 4.4).
#pragma once

#include "iteration/iteration_options.h"

#include <vector>

namespace koebe {

/// The loops that one step opens: two, or one with the conventional method.
using OpenedLoops = std::vector<int>;

/// The steps of one sweep, every loop opened in one of them at least.
using Sweep = std::vector<OpenedLoops>;

/// Whether a loop keeps its partner (gk). Partners that change, as in Fig. 4, settle on a cycle of maps that differ by
/// the discretization, not on one map.
enum class Partners { fixed, changing };

/// The same sweep again and again. gk: disjoint pairs (0,1), (2,3), ..., with an odd number (0, last) besides. ck: each
/// loop. against_outer: (0,k) for each k > 0.
Sweep fixed_sweep(int loop_count, Method method);

/// A round of sweeps, in which every loop meets every other as its partner: n - 1 sweeps of n / 2 pairs for n loops,
/// by the circle method of tournaments. With an odd number each sweep's odd one meets loop 0 besides, or loop 0 loop 1.
std::vector<Sweep> round_of_changing_pairs(int loop_count);

/// @throws InputError a step of the schedule names a loop that there is not, or one twice; a loop is never opened; a
///         step opens two loops with the conventional method, or one with another, or with two loops; against_outer
///         without loop 0
void require_schedule(const Sweep& schedule, int loop_count, Method method);

}  // namespace koebe
