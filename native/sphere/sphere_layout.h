// Lays the sphere out as UVs, cut in the UVs only.
#pragma once

#include "sphere/sphere_map.h"

namespace koebe {

/// (3F, 2) UVs of the corners of all faces. All are multiples of 2^-23 and 32-bit floats. The two sides of a cut are
/// the same points of the continued pattern to the last bit.
///
/// equirectangular: u = (longitude + pi) / 2 pi, v = (latitude + pi / 2) / pi. The pattern has the period 1 along u. A
/// face across the cut goes on beyond 1, so u is in [0, 2). A corner at a pole has no longitude: it takes the mean of
/// its face's other two. A face round a pole is torn: its corners go round once, and one of the three steps is left out
/// so that the face is upright if possible.
///
/// octahedral: the point over |x| + |y| + |z|, the upper half as |u'| + |v'| <= 1 in [-1, 1]^2, the lower faces folded
/// out over its sides, u = (1 + u') / 2, v = (1 + v') / 2. The cut runs from (0, 0, -1) to the four points of the
/// equator (+-1, 0, 0) and (0, +-1, 0), which are the middles of the square's sides. Beyond a side the pattern is
/// turned by half a turn round the side's middle. A face across the cut goes on beyond the square, from the place of
/// its own middle. A face round one of the four points is torn. join_polygons puts polygons together.
/// @param points (V, 3) unit vectors @param turned (F) 1 for faces with the other orientation
/// @param polygon (F) faces of one number are one polygon; empty: each face by itself
/// @param report out
PlanarPoints sphere_layout(const Triangles& triangles, const Vertices& points, const std::vector<char>& turned,
                           const std::vector<Index>& polygon, SphereLayout layout, SphereLayoutReport& report);

/// The nearest multiple of 2^-23.
double on_uv_steps(double t);

}  // namespace koebe
