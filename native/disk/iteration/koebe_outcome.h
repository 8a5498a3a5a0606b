// The result of a Koebe iteration with either engine.
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"

#include <utility>
#include <vector>

namespace koebe {

/// One step of the Koebe iteration. In the condensed engine the steps of a sweep take effect together, unless in turn.
/// They share the sweep's change; the last of them has its roundness, the others have the roundness before.
struct KoebeStep {
    int step = 0;
    std::pair<int, int> pair{0, 0};  ///< the two loops left open; (k, k) for one loop
    double change = 0.0;             ///< (sum |c' - c|^2 + |r' - r|^2)^(1/2) over all circles (paper, section 4.4)
    MeanRoundness mean_roundness;
    std::vector<Circle> circles;  ///< after the step, or after all steps that take effect together
};

/// The part of the result that the rest of the pipeline needs.
struct KoebeOutcome {
    std::vector<VectorXcd> loops;  ///< image of each loop in the unit disk: the first on the unit circle, the others
                                   ///< round up to the resolution of the mesh
    std::vector<KoebeStep> history;
    int sweeps = 0, steps = 0;
    bool converged = false;
    int raised_angles = 0;  ///< boundary nodes whose flux vanished in the last sweep
    /// The start for a run on a surface of nearly the same shape (koebe_condensed).
    std::vector<VectorXd> angles;  ///< of each loop's vertices
    double contraction = 1.0;      ///< the largest ratio of a sweep's change to the change before
    /// If asked for: per step (V), the step's image of the surface, with the first loop that it opened on the unit
    /// circle.
    std::vector<VectorXcd> step_images;
};

}  // namespace koebe
