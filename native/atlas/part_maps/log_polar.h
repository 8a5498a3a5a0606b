// Log polar coordinates of a part about a point, and the longest even tube in them.
#pragma once

#include "part_maps/part_map.h"

namespace koebe {

/// Coordinates about a point p: t = log |(z - p) / (1 - conj(p) z)| is 0 on the unit circle. v is u of the unrolled
/// tube.
struct LogPolar {
    VectorXd t, v;                                 ///< (F); t is -infinity for faces lost in rounding
    int hole = -1;                                 ///< the loop round p; -1: p is in no hole
    std::vector<std::pair<double, double>> loops;  ///< the range of t of each other loop
};

LogPolar log_polar(const PartMesh& part, const PartMap& map, Complex about, int hole);

struct TubeRange {
    double from = 0.0, until = 0.0, area = 0.0;  ///< range of t; the area is 0 if no tube was found
};

/// The annulus of most area that is at least 0.8 long in t, has no other loop inside, and has `share` of its area
/// within even_range in v. Uses a histogram of t and v with running sums. About a tip the inner end then moves outward,
/// to the first place where the rest inside is an even disk.
/// @param share share of the annulus's area
TubeRange longest_tube(const PartMesh& part, const PartMap& map, const LogPolar& polar, double share);

}  // namespace koebe
