// The conformal module: numbers that distinguish circle domains (paper, Fig. 13).
#pragma once

#include "circles/moebius.h"
#include "core/api.h"
#include "core/types.h"
#include "pipeline/result.h"

#include <string>
#include <vector>

namespace koebe {

/// Coordinates of a circle domain in the moduli space of numbered loops (paper, Fig. 13): two surfaces of genus 0 with
/// numbered boundary loops are conformally equivalent, orientation kept, if and only if their modules are equal.
///
/// The loop order[0] goes to the unit circle, the centre of the loop order[1] to 0 and the centre of order[2] onto the
/// positive y axis. The module is the rest, (r_1, y_2, r_2, x_3, y_3, r_3, x_4, …), lengths in the unit disk: 3n - 3
/// numbers for n >= 2 inner circles, r_1 for one, no number for a disk. Up to two inner circles a mirror image has the
/// same module, as every such domain is its own mirror image; from three on the x coordinates change sign.
///
/// @param circles the unit circle first, the others inside it, no two disks touching
/// @param order a permutation of the circles, by default the identity
/// @throws InputError not a permutation; circles that meet or lie outside (their numbers listed)
KOEBE_API VectorXd conformal_module(const std::vector<Circle>& circles, const std::vector<int>& order = {});

/// The names of the numbers: "r_1", "y_2", "r_2", "x_3", …
KOEBE_API std::vector<std::string> module_names(std::size_t loop_count);

/// The circles, renumbered, in the module's position: the unit circle, a circle concentric with it, a circle with its
/// centre on the positive y axis, the rest. Arguments as in conformal_module.
std::vector<Circle> normalized_circles(const std::vector<Circle>& circles, const std::vector<int>& order = {});

/// The automorphism of the disk to that position for circles in order: number 1 to the middle, 2 onto the y axis.
Moebius normalizing_map(const std::vector<Circle>& circles);

/// An order that depends on the conformal structure alone, not on the loops' numbers: the outer loop, then the others
/// by conformal_separation from it, nearest first. Loops within 0.01 of each other count as equal. Up to 5040 orders
/// are left. The order whose module has the greatest sum of m_i / (i + 1), i from 0, is taken. Every such choice jumps
/// somewhere, so compare two shapes by match_loops.
/// @param any_outer choose the outer loop, too: the loop of least sum of separations
KOEBE_API std::vector<int> canonical_order(const std::vector<Circle>& circles, bool any_outer = false);

/// log(R / r) of the concentric circles to which a Moebius map takes two disjoint circles: acosh of their inversive
/// distance, 2 pi times the modulus of the ring between them. Invariant under Moebius maps, dimensionless.
double conformal_separation(const Circle& a, const Circle& b);

/// @throws InputError the first circle is not the unit circle, circles meet, lie outside or have a radius below 1e-100,
/// whose square vanishes (their numbers listed)
void require_circle_domain(const std::vector<Circle>& circles);

/// Requires circles that are the surface's own. A module describes these only, not circles that replaced the
/// iteration's on a coarse mesh.
/// @throws InputError with the loops of other circles
KOEBE_API void require_own_circles(const std::vector<LoopReport>& loops);

}  // namespace koebe
