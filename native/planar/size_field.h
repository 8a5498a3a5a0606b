// The wanted edge length at each place of a planar region.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// size(x) = min(longest, min_v (h_v + gradation |x - v|)) over the polygons' vertices v, h_v the mean of their two
/// edges. Vertices are kept in runs along the boundary with a bound for each run, so that most vertices are skipped.
class SizeField {
public:
    SizeField(const std::vector<VectorXcd>& polygons, double longest, double gradation);
    double operator()(Complex place) const;

private:
    struct Site {
        Complex place;
        double length;
    };
    struct Run {
        std::size_t begin, end;
        Complex center;
        double radius;    // of a disk around center that holds the run's sites
        double shortest;  // least wanted length in the run
    };
    double longest_, gradation_;
    std::vector<Site> sites_;
    std::vector<Run> runs_;
};

}  // namespace koebe
