// Uses the freedom that circles leave, when one domain is laid over another, to align landmarks.
#pragma once

#include "circles/circle.h"
#include "circles/moebius.h"

#include <vector>

namespace koebe {

/// The automorphism of the disk that keeps each of these circles and takes points nearest to their targets.
///
/// Without a hole it is any automorphism. It minimizes sum |g(z) - t|^2 in the position with the targets' conformal
/// barycentre at 0 [Douady and Earle 1986, section 2], so that automorphisms of both domains do not matter. It is exact
/// where possible: for one point, for one inside and one on the rim, for three on the rim. With one hole only rotations
/// are left, and the mean angle counts. With more holes it is the identity.
/// @param circles of the domain, the unit circle first @param points, targets (n) of the closed unit disk
Moebius nearest_symmetry(const std::vector<Circle>& circles, const VectorXcd& points, const VectorXcd& targets);

}  // namespace koebe
