// Uses the freedom that circles leave, when one domain is laid over another, to align landmarks.
#pragma once

#include "circles/circle.h"
#include "circles/moebius.h"
#include "shape/domain_alignment.h"

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

/// The best alignment for circles and landmarks together, if all matches of the loops can be tried: up to five holes.
/// The nearest module alone may confuse holes, and landmarks tell them apart.
/// @param source, target circles @param now, wanted (n) places of the landmarks in the target's and the source's domain
/// @throws InputError, Cancelled as align_domains
DomainAlignment align_by_landmarks(const std::vector<Circle>& source, const std::vector<Circle>& target,
                                   const VectorXcd& now, const VectorXcd& wanted, const ExecutionContext& context = {});

/// A domain laid over another, and the domain that counts as undistorted.
struct AlignedDomain {
    PlanarPoints uv, undistorted;
};

/// Moves a domain by the map and the best symmetry for the landmarks. Where that would turn large faces over, applies
/// as much of the symmetry as turns none, and the domain before counts as undistorted.
/// @param uv (V, 2) the domain @param circles it is laid over @param now, wanted (n) places of the landmarks
/// @param map changed to the applied map
AlignedDomain lay_by_landmarks(const Triangles& triangles, const PlanarPoints& uv, const std::vector<Circle>& circles,
                               const VectorXcd& now, const VectorXcd& wanted, Moebius& map);

}  // namespace koebe
