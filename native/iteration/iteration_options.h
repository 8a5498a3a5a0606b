// What a Koebe iteration of either engine takes besides its surface.
#pragma once

#include "core/map_options.h"

namespace koebe {

/// gk: generalized Koebe iteration, two loops a step (section 4.4, second algorithm). ck: the conventional one, one
/// loop a step and all others filled, the outer one too (section 1.2). against_outer: one hole a step, and the outer
/// loop never filled (section 4.4, first algorithm).
enum class Method { gk, ck, against_outer };

struct IterationOptions : SweepOptions {
    Method method = Method::gk;
    bool in_turn = false;  ///< GK's steps of a sweep follow each other in the condensed engine, too (koebe_condensed)
};

}  // namespace koebe
