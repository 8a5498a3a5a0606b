// The cost of uneven texel density.
#pragma once

#include "core/types.h"
#include "cost/costs.h"

#include <vector>

namespace koebe {

struct Evenness {
    double overflow = 0.0;  ///< sum of area times the distance of u from [from, from + even_range]; the distance counts
                            ///< at most lost_cost
    double from = 0.0;      ///< the lower end of the best window; the middle of a range of equally good ends
    double inside = 0.0;    ///< area within the window
};

/// The window of least overflow: as much area lies below as above it. The faces are sorted once.
/// @param u (F) @param areas (F)
/// @param lost (F) 1: the face has no area in the map, and costs lost_cost for every window; empty: no face is lost
Evenness evenness(const VectorXd& u, const VectorXd& areas, const std::vector<char>& lost = {});

/// Nearly the same overflow, from a histogram instead of sorting. For comparing many maps of one part.
double rough_overflow(const VectorXd& u, const VectorXd& areas);

}  // namespace koebe
