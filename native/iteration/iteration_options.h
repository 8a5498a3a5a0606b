// What a Koebe iteration of either engine takes besides its surface.
#pragma once

namespace koebe {

/// gk: generalized Koebe iteration, two loops a step (section 4.4, second algorithm). ck: the conventional one, one
/// loop a step and all others filled, the outer one too (section 1.2). against_outer: one hole a step, and the outer
/// loop never filled (section 4.4, first algorithm).
enum class Method { gk, ck, against_outer };

struct IterationOptions {
    Method method = Method::gk;
    double tolerance = 1e-6;  ///< on the circles' change in a sweep, a length in the unit disk
    int max_sweeps = 50;
    bool in_turn = false;  ///< GK's steps of a sweep follow each other in the condensed engine, too (koebe_condensed)
};

}  // namespace koebe
