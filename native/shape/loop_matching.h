// Which loops of two circle domains correspond.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct LoopMatch {
    std::vector<int> order_a, order_b;  ///< corresponding loops stand at the same place, the outer ones first
    double distance = 0.0;              ///< of the two modules in these orders
    bool exhaustive = true;             ///< every correspondence was tried
};

/// The correspondence of the loops with the least L2 distance of the conformal modules (that of the paper's Fig. 13,
/// where the user names the loops).
///
/// Both modules are taken in one order: by the sum of the two loops' separations from the outer loop (see
/// conformal_separation), so that the loops which fix the position are large ones. Hence the distance is symmetric, 0
/// only for equal shapes, and blind to how loops are numbered and to Moebius maps; the triangle inequality is not
/// promised. Up to 7 inner loops all correspondences are tried. With more the best are sought among those that two
/// pairs of loops induce: both domains are put into the position of their pair, the other loops assigned at the
/// least sum of squared differences of centres and radii, and this repeated from the order that comes out. From 250
/// loops on fewer than 32 such starts are followed up, 8 of 1000 loops: those whose circles come nearest to each other,
/// and no more once an assignment of nearest circles would be farther than what was found.
///
/// @param any_outer the outer loop of one may correspond to an inner loop of the other; of more than 32 loops those are
///        tried whose separations from the others are likest, as many as there are pairs
/// @throws InputError different numbers of loops; no circle domain (require_circle_domain); Cancelled
KOEBE_API LoopMatch match_loops(const std::vector<Circle>& a, const std::vector<Circle>& b, bool any_outer = false,
                                const ExecutionContext& context = {});

}  // namespace koebe
