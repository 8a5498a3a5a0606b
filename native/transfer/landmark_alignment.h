// The freedom that circles leave when one domain is laid over another, used for landmarks.
#pragma once

#include "circles/circle.h"
#include "circles/moebius.h"

#include <vector>

namespace koebe {

/// The automorphism of the disk that fixes each of these circles and takes points nearest to their targets.
///
/// Without a hole every automorphism does: sum |g(z) - t|^2 is least, in the position that has the targets' conformal
/// barycentre at 0 [Douady and Earle 1986, section 2], so that no automorphism of both matters. It is exact wherever it
/// can be: for one point, for one inside and one on the rim, for three on the rim. With one hole the turns about it are
/// left, and the mean angle counts. With more holes there is the identity alone.
/// @param circles of the domain, the unit circle first @param points, targets (n) of the closed unit disk
Moebius nearest_symmetry(const std::vector<Circle>& circles, const VectorXcd& points, const VectorXcd& targets);

}  // namespace koebe
