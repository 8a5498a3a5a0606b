// The conformal module: the numbers that tell circle domains apart (paper, Fig. 13).
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
/// The loop order[0] goes to the unit circle, the centre of the loop order[1] to 0 and that of order[2] onto the
/// positive y axis. What is left is (r_1, y_2, r_2, x_3, y_3, r_3, x_4, …), lengths in the unit disk: 3n - 3 numbers
/// for n >= 2 inner circles, r_1 alone for one, none for a disk. Up to two inner circles a mirror image has the same
/// module, as every such domain is its own mirror image; from three on the x coordinates change their sign.
///
/// @param circles the unit circle first, the others inside it, no two disks touching
/// @param order a permutation of the circles, by default as they are
/// @throws InputError no permutation; circles that meet or lie outside (their numbers listed)
KOEBE_API VectorXd conformal_module(const std::vector<Circle>& circles, const std::vector<int>& order = {});

/// What the numbers are called: "r_1", "y_2", "r_2", "x_3", …
KOEBE_API std::vector<std::string> module_names(std::size_t loop_count);

/// The circles, renumbered, in the position that the module describes: the unit circle, one concentric with it, one
/// with its centre on the positive y axis, the rest. As above.
std::vector<Circle> normalized_circles(const std::vector<Circle>& circles, const std::vector<int>& order = {});

/// The automorphism of the disk that does this to circles numbered as they are: 1 to the middle, 2 onto the y axis.
Moebius normalizing_map(const std::vector<Circle>& circles);

/// An order that depends on the conformal structure alone, not on how the loops are numbered: the outer loop, then the
/// others by conformal_separation from it, nearest first. Loops within 0.01 of each other count as alike, and of
/// the orders that this leaves (up to 5040) the module with the greatest sum of m_i / (i + 1) decides, i from 0.
/// As every such choice it jumps somewhere: match_loops is what compares two shapes.
/// @param any_outer the outer loop is chosen too: that of the least sum of separations
KOEBE_API std::vector<int> canonical_order(const std::vector<Circle>& circles, bool any_outer = false);

/// log(R / r) of the concentric circles to which a Moebius map takes two disjoint ones: acosh of their inversive
/// distance, 2 pi times the modulus of the ring between them. Free of Moebius maps, dimensionless.
double conformal_separation(const Circle& a, const Circle& b);

/// @throws InputError the first circle is not the unit circle, circles meet, lie outside or have a radius
///         below 1e-100, of which the square vanishes (their numbers listed)
void require_circle_domain(const std::vector<Circle>& circles);

/// A module tells about circles that the surface has; where the mesh was too coarse for the iteration's, and others
/// took their place, there is none.
/// @throws InputError with the loops of such circles
KOEBE_API void require_own_circles(const std::vector<LoopReport>& loops);

}  // namespace koebe
