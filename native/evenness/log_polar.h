// A part seen in log polar coordinates about a point, and the longest even tube there.
#pragma once

#include "evenness/part_map.h"

namespace koebe {

/// About p: t = log |(z - p) / (1 - conj(p) z)|, 0 on the unit circle; v is u of the unrolled tube.
struct LogPolar {
    VectorXd t, v;                                 ///< (F); t is -infinity where the map is lost in rounding
    int hole = -1;                                 ///< the loop about which it is, or none
    std::vector<std::pair<double, double>> loops;  ///< t of the other loops, from and until
};

LogPolar log_polar(const PartMesh& part, const PartMap& map, Complex about, int hole);

struct TubeRange {
    double from = 0.0, until = 0.0, area = 0.0;  ///< of t; the area is 0 if there is none
};

/// The annulus of most area that is at least 0.8 long, has no other loop inside, and so much of its area within
/// even_range in v: by a histogram of t and v with running sums. About a tip its inner end is then moved out to where
/// the rest inside is an even disk.
/// @param share of the area
TubeRange longest_tube(const PartMesh& part, const PartMap& map, const LogPolar& polar, double share);

}  // namespace koebe
