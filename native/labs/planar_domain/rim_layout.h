// Where the rational functions of one rim have their poles, and the samples on the rim that determine them.
#pragma once

#include "circles/circle.h"
#include "core/types.h"
#include "planar_domain/planar_rim.h"

#include <vector>

namespace koebe {

struct RimResolution {
    int corner_poles;   ///< for each corner
    int panel_poles;    ///< for each panel: a stretch of a rim that is not longer than its distance to what bends it
    int circle_points;  ///< on a rim that has become a circle
};

/// A corner with its local coordinate w = sqrt((z - vertex) / (z - cut_end)), which is cut along the segment between
/// the two, off the domain, and takes the domain's side of the corner into the right half plane. Poles lie at negative
/// real w: the corner's singularity is approximated there as a power on [0, 1] is by rational functions, with an error
/// that falls like exp(-c sqrt(number of poles)) (Gopal and Trefethen 2019; Herremans, Huybrechs and Trefethen 2023).
struct RimCorner {
    Complex vertex, cut_end;
    std::vector<double> poles;  ///< w, all negative
};

/// A point of a rim. Near a corner the offset from it is kept as well: it is exact where z would be rounded.
struct RimSample {
    Complex place;
    int corner = -1;
    Complex offset = 0.0;
};

struct RimLayout {
    bool is_outer = false;
    Complex center;  ///< a place inside the rim
    std::vector<RimCorner> corners;
    std::vector<Complex> poles;      ///< beside the rim, off the domain
    std::vector<RimSample> samples;  ///< counter-clockwise
};

/// @param is_outer the domain is inside the rim; else it is outside
RimLayout rim_layout(const PlanarRim& rim, const RimPolygon& polygon, bool is_outer, const RimResolution& resolution);

/// A rim that is a circle: samples only.
RimLayout circle_layout(const Circle& circle, bool is_outer, int points);

}  // namespace koebe
