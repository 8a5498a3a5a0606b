// Lays one circle domain over another by an automorphism of the disk.
#pragma once

#include "circles/moebius.h"
#include "core/api.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct DomainAlignment {
    Moebius map;                 ///< target domain -> source domain
    std::vector<int> match;      ///< the target's loop for each loop of the source; 0 for loop 0
    double residual = 0.0;       ///< root of the mean over the holes of |difference of centres|^2 + (of radii)^2
    double largest = 0.0;        ///< largest such root over the holes; lengths in the unit disk
    int worst = 0;               ///< number of that hole in the source, 0 without holes
    std::vector<double> misses;  ///< this root for each loop of the source; 0 for the outer loop
    int iterations = 0;
    bool converged = true;
    double margin = 1.0;  ///< of the match, as in LoopMatch; 1 if it was given, or found by landmarks
};

/// The automorphism of the unit disk that takes the target's circles nearest to the source's, by least squares of
/// centres and radii. Uses the damped Gauss-Newton method on its three parameters, started where two corresponding
/// loops lie alike. match_loops finds the corresponding loops. The residual is 0 if and only if the domains are
/// conformally equivalent. With one hole the circles leave the rotation free, without holes everything: the free part
/// is the identity's.
/// @param match as in the result, or empty to search it
/// @throws InputError as match_loops; a match that is not a permutation or moves the outer loop; Cancelled
KOEBE_API DomainAlignment align_domains(const std::vector<Circle>& source, const std::vector<Circle>& target,
                                        std::vector<int> match = {}, const ExecutionContext& context = {});

}  // namespace koebe
