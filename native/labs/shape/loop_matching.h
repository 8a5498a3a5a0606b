// Finds the corresponding loops of two circle domains.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct LoopMatch {
    std::vector<int> order_a, order_b;  ///< corresponding loops stand at the same place, the outer ones first
    double distance = 0.0;              ///< between the two modules in these orders
    bool exhaustive = true;             ///< whether every correspondence was tried
    double margin = 1.0;                ///< 1 - distance / the next best correspondence's: 0 for two that fit alike
};

/// Below this margin the loops may be matched wrongly: of 77 pairs of made atria, 49 of them of nearly two-fold
/// symmetry, every wrong match had a smaller one.
inline constexpr double ambiguous_margin = 0.3;

/// The correspondence of the loops with the least L2 distance of the conformal modules (the distance of the paper's
/// Fig. 13, where the user names the loops).
///
/// Both modules are taken in one order: by the sum of the two loops' separations from the outer loop (see
/// conformal_separation), so that large loops fix the position. Hence the distance is symmetric, 0 only for equal
/// shapes, and independent of the loops' numbers and of Moebius maps; the triangle inequality is not guaranteed. Up to
/// 7 inner loops all correspondences are tried. With more, two pairs of loops are a start: both domains are put into
/// the position of their pair, and the other loops assigned at the least sum of squared differences of centres and
/// radii; this is repeated from the resulting order. From 250 loops on fewer than 32 starts are followed, for 1000
/// loops 8: those whose circles come nearest to each other. The search ends when even an assignment of nearest circles
/// would be farther than the best so far.
///
/// @param any_outer the outer loop of one domain may correspond to an inner loop of the other; with more than 32 loops
/// only those with the most similar separations are tried, as many as there are pairs
/// @throws InputError different numbers of loops; not a circle domain (require_circle_domain); Cancelled
KOEBE_API LoopMatch match_loops(const std::vector<Circle>& a, const std::vector<Circle>& b, bool any_outer = false,
                                const ExecutionContext& context = {});

}  // namespace koebe
