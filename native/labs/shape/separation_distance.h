// A distance of circle domains that depends on no order of the loops, and is a metric.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// (L, L) conformal_separation of each two circles, 0 on the diagonal: invariant under Moebius maps and reflections.
///
/// The matrix determines the domain up to these. A disk is a unit vector of Lorentz space, and minus the hyperbolic
/// cosine of a separation is the product of two of them. Vectors with the same products differ by an isometry (Witt).
/// @throws InputError not a circle domain (require_circle_domain)
KOEBE_API MatrixXd conformal_separations(const std::vector<Circle>& circles);

struct SeparationMatch {
    std::vector<int> match;  ///< b's loop for each of a's
    double distance = 0.0;   ///< root of the mean squared difference of separations, over all pairs of loops
};

/// The least distance over all correspondences of the loops, or over those that keep the outer loops together. With a
/// correspondence it is the Euclidean distance of two vectors, and correspondences permute their coordinates. So it is
/// symmetric, obeys the triangle inequality, and is 0 only for domains that are equal or mirror images. Correspondences
/// are searched depth first, and left where a bound of them is farther than the best.
///
/// @param any_outer the outer loop of one domain may correspond to an inner loop of the other
/// @throws InputError different numbers of loops; not a circle domain; so many loops, or so many alike, that the search
/// is too long (give the match); Cancelled
KOEBE_API SeparationMatch match_separations(const std::vector<Circle>& a, const std::vector<Circle>& b,
                                            bool any_outer = false, const ExecutionContext& context = {});

/// The distance for one correspondence. @param match b's loop for each of a's @throws InputError not a permutation
KOEBE_API double separation_distance(const std::vector<Circle>& a, const std::vector<Circle>& b,
                                     const std::vector<int>& match);

}  // namespace koebe
