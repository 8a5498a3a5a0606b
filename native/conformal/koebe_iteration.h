// What the Koebe iterations of both engines share: the order of the pairs, the circles, the termination test.
#pragma once

#include "conformal/result.h"
#include "core/types.h"

#include <utility>
#include <vector>

namespace koebe {

/// What a Koebe iteration of either engine hands to the finish.
struct KoebeOutcome {
    std::vector<VectorXcd> loops;  ///< image of each loop in the unit disk: the first on the unit circle, the others
                                   ///< round up to the resolution of the mesh
    std::vector<KoebeStep> history;
    int sweeps = 0, steps = 0;
    bool converged = false;
    int raised_angles = 0;         ///< boundary nodes whose flux vanished in the last sweep
};

/// The pairs of loops opened in one sweep, each loop in at least one: disjoint ones, (0,1), (2,3), ... for the
/// generalized form, with an odd number (0, last) besides; (0,k) for each k for the conventional one. The same in
/// every sweep: partners that change settle on a cycle of maps that differ by the discretization, not on one map.
std::vector<std::pair<int, int>> sweep_pairs(int loop_count, Method method);

struct CircleState {
    std::vector<Circle> circles;
    double mean_roundness = 0.0;  ///< mean e(gamma_k) over all loops (paper, section 5)
};

/// The circle of each loop's image by the given fit, and how round the images are.
CircleState circle_state(const std::vector<VectorXcd>& images, Circle (*fit)(const VectorXcd&));

/// (sum |c' - c|^2 + |r' - r|^2)^(1/2), the paper's termination test (section 4.4). A first state is compared with
/// circles of radius 0 at the origin.
double circle_change(const CircleState& before, const CircleState& after);

}  // namespace koebe
