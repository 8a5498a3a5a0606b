// The options of a Koebe iteration with either engine.
#pragma once

#include "core/map_options.h"

namespace koebe {

/// gk: generalized Koebe iteration, two loops a step (section 4.4, second algorithm). ck: the conventional one, one
/// loop a step with all others filled, the outer loop too (section 1.2). against_outer: one hole a step, the outer loop
/// is never filled (section 4.4, first algorithm).
enum class Method { gk, ck, against_outer };

struct IterationOptions : SweepOptions {
    Method method = Method::gk;
    /// The condensed engine takes GK's steps one after another too, each from the angles of the last one: block
    /// Gauss-Seidel, as the paper has it, in place of block Jacobi (koebe_condensed).
    bool gauss_seidel = false;
};

}  // namespace koebe
