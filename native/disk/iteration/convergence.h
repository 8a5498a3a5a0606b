// Ends a Koebe iteration when its circles hardly move (paper, section 4.4).
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct CircleState {
    std::vector<Circle> circles;
    MeanRoundness mean_roundness;
};

/// The circle of each loop's image by least squares, and how round the images are.
CircleState circle_state(const std::vector<VectorXcd>& images);

/// (sum |c' - c|^2 + |r' - r|^2)^(1/2), a length: the root of the number in the paper's termination test (section 4.4;
/// docs/method.md, M11). The first state is compared with circles of radius 0 at the origin.
double circle_change(const CircleState& before, const CircleState& after);

/// Whether the circles moved by less than the tolerance in a sweep. With two loops one step is exact, as it does not
/// depend on the state before.
bool has_converged(const CircleState& before_sweep, const CircleState& after, double tolerance);

/// Whether more rounds would be in vain: the last one moved the circles as far as the one ten rounds before.
/// @param changes of all rounds so far
bool is_at_standstill(const std::vector<double>& changes);

}  // namespace koebe
