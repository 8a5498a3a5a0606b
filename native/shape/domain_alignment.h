// One circle domain laid over another, as well as an automorphism of the disk can.
#pragma once

#include "circles/moebius.h"
#include "core/api.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct DomainAlignment {
    Moebius map;                 ///< target domain -> source domain
    std::vector<int> match;      ///< the target's loop for each loop of the source; 0 for 0
    double residual = 0.0;       ///< root of the mean over the holes of |difference of centres|^2 + (of radii)^2
    double largest = 0.0;        ///< the root for the worst hole; lengths in the unit disk
    int worst = 0;               ///< that hole's number in the source, 0 if there is none
    std::vector<double> misses;  ///< that root for each loop of the source; 0 for the outer one
    int iterations = 0;
    bool converged = true;
};

/// The automorphism of the unit disk that takes the target's circles nearest to the source's, in the least-squares
/// sense of centres and radii: Gauss-Newton's method on its three parameters with damping, started from the positions
/// in which two corresponding loops lie alike. Which loops correspond is what match_loops finds; residual 0 if and
/// only if the domains are conformally equivalent. With one hole the circles leave the rotation free, and without a
/// hole everything: the free part stays that of the identity.
/// @param match as in the result, or empty to look for it
/// @throws InputError as match_loops; a match that is no permutation or moves the outer loop; Cancelled
KOEBE_API DomainAlignment align_domains(const std::vector<Circle>& source, const std::vector<Circle>& target,
                                        std::vector<int> match = {}, const ExecutionContext& context = {});

}  // namespace koebe
