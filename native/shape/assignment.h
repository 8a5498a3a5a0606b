// Who goes with whom at the least cost.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// The permutation p with the least sum of cost(i, p[i]), by shortest augmenting paths in O(n^3)
/// [Kuhn 1955; Jonker and Volgenant 1987].
/// @param cost (n, n), finite
std::vector<int> least_cost_assignment(const MatrixXd& cost);

}  // namespace koebe
