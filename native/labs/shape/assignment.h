// The assignment problem: pairs rows and columns at the least cost.
#pragma once

#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// The permutation p with the least sum of cost(i, p[i]).
///
/// Runs the network simplex method [Kiraly and Kovacs 2012; LEMON] on a few cheap pairs of each row and column. Its
/// prices then tell for every other pair whether it could lower the sum. Such pairs are added, until there are none. So
/// the result is the best of all permutations, for costs rounded to 2^-40 of their range (to n 2^-54 from 16,384 rows
/// on).
/// @param cost (n, n), finite
/// @throws Cancelled, tested before each solution
std::vector<int> least_cost_assignment(const MatrixXd& cost, const ExecutionContext& context = {});

}  // namespace koebe
