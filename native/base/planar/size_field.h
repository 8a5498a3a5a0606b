// The wanted edge length at each place of a planar region.
#pragma once

#include "core/types.h"

#include <limits>
#include <vector>

namespace koebe {

/// size(x) = min(longest, min_v (h_v + gradation |x - v|)) over the polygons' vertices v, h_v the mean of their two
/// edges. Vertices are kept in runs along the boundary, and runs in runs of runs, with a bound for each run. So a query
/// looks at a few runs of each level, and at fewer near the place of the last query: one thread at a time may ask.
class SizeField {
public:
    SizeField(const std::vector<VectorXcd>& polygons, double longest, double gradation);
    double operator()(Complex place) const;

private:
    /// Consecutive vertices, or runs of the level below.
    struct Run {
        std::size_t begin = 0, end = 0;
        Complex center;
        double radius = 0.0;    // of a disk around center that holds the run's vertices
        double shortest = 0.0;  // least wanted length in the run
    };
    double least_in(const Run& run, Complex place) const;
    void look(std::size_t level, std::size_t begin, std::size_t end, Complex place, double& size) const;

    double longest_, gradation_;
    mutable Complex last_place_;
    mutable double last_size_ = std::numeric_limits<double>::infinity();
    std::vector<std::vector<Run>> levels_;  // vertices, runs of them, and so on; the last level is one short run
};

}  // namespace koebe
