// What a Koebe iteration of either engine takes besides its surface, and what it gives.
#pragma once

#include "circles/circle_fit.h"
#include "core/map_options.h"
#include "core/types.h"

#include <utility>
#include <vector>

namespace koebe {

/// gk: generalized Koebe iteration, two loops a step (section 4.4, second algorithm). ck: the conventional one, one
/// loop a step and all others filled, the outer one too (section 1.2). against_outer: one hole a step, and the outer
/// loop never filled (section 4.4, first algorithm).
enum class Method { gk, ck, against_outer };

struct IterationOptions : SweepOptions {
    Method method = Method::gk;
    bool in_turn = false;  ///< GK's steps of a sweep follow each other in the condensed engine, too (koebe_condensed)
};

/// One step of the Koebe iteration. The condensed engine's steps of one sweep take effect together, unless in turn:
/// they share the sweep's change, and its roundness stands in the last of them, the one before in the others.
struct KoebeStep {
    int step = 0;
    std::pair<int, int> pair{0, 0};  ///< the two loops left open; (k, k) where it is one
    double change = 0.0;             ///< (sum |c' - c|^2 + |r' - r|^2)^(1/2) over all circles (paper, section 4.4)
    MeanRoundness mean_roundness;
    std::vector<Circle> circles;  ///< of the loops after the step, or after those that take effect together
};

/// What a Koebe iteration of either engine hands to the finish.
struct KoebeOutcome {
    std::vector<VectorXcd> loops;  ///< image of each loop in the unit disk: the first on the unit circle, the others
                                   ///< round up to the resolution of the mesh
    std::vector<KoebeStep> history;
    int sweeps = 0, steps = 0;
    bool converged = false;
    int raised_angles = 0;  ///< boundary nodes whose flux vanished in the last sweep
    /// Where a run on a surface of nearly the same shape can begin (koebe_condensed).
    std::vector<VectorXd> angles;  ///< of the vertices of each loop
    double contraction = 1.0;      ///< the largest share of a sweep's change that the next sweep had
    /// (V) per step, if asked for: where its map takes the surface, the first loop that it opened on the unit circle.
    std::vector<VectorXcd> step_images;
};

}  // namespace koebe
