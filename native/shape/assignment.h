// Who goes with whom at the least cost.
#pragma once

#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// The permutation p with the least sum of cost(i, p[i]).
///
/// By the network simplex method [Kiraly and Kovacs 2012; LEMON] over a few of the pairs, those that are cheap for
/// either side. Its prices then tell of every other pair whether it could lower the sum; those that could are added,
/// until none is left. So the result is the best of all permutations, for costs rounded to 2^-40 of their range (to n
/// 2^-54 from 16,384 rows on).
/// @param cost (n, n), finite
/// @throws Cancelled, asked before each solution
std::vector<int> least_cost_assignment(const MatrixXd& cost, const ExecutionContext& context = {});

}  // namespace koebe
