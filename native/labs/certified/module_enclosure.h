// The circles of a surface with three or four loops, enclosed with proof.
#pragma once

#include "certified/capacities.h"
#include "certified/interval.h"
#include "core/types.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

constexpr int most_enclosed_loops = 4;

/// The iteration's circles in the module's position (shape/conformal_module.h), another circle outside and another in
/// the middle: as far apart, for their radii, as they can be. Bounds are narrowest there. Nothing of it is trusted.
struct NearModule {
    VectorXd numbers;               ///< (3 n - 6)
    std::vector<int> order;         ///< the loop (its number in Surface::loops) of each circle, the unit circle first
    std::vector<int> wanted_order;  ///< the same of the enclosed module: by falling length
    bool may_narrow = true;         ///< false after an error of enclose_module that narrower capacities cannot mend
};

/// @throws KoebeError if the iteration finds no circles; Cancelled
NearModule near_module(const Vertices& vertices, const Surface& surface, int threads, ExecutionContext& context);

/// Encloses the module from as many capacities as it has numbers.
///
/// Let C(m) be the capacities of the circle domain with the module m, C* those of the surface, m_c a place near by and
/// M the inverse of the derivative of C there. If |M (C* - C(m_c))| + e < rho in each number, where e bounds
/// |M (C(m) - C(m_c)) - (m - m_c)| for all m with |m - m_c| <= rho, then m -> m - M (C(m) - C*) takes this box into
/// itself. By Brouwer's theorem it has a fixed point, so there is an m in the box with C(m) = C*, and
/// m = m_c + M (C* - C(m_c)) up to e.
///
/// The capacities are the periods of the surface's double. By Torelli's theorem (Weil 1957) they determine the surface
/// up to its mirror image. So m or its mirror image is the surface's module. A domain of three circles is its own
/// mirror image. Between four circles the mirror image has -x_3 (docs/reliability.md).
///
/// The box is then moved to the wanted order, in intervals.
///
/// @param near moved towards the module by Newton's method
/// @param capacities those of loop_condensers @return (3 n - 6) in near.wanted_order
/// @throws SolverError why there is no box; InputError circles that meet on the way; Cancelled
std::vector<Interval> enclose_module(NearModule& near, const std::vector<Capacity>& capacities,
                                     ExecutionContext& context);

}  // namespace koebe
