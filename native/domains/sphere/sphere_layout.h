// Lays the sphere out as UVs, cut in the UVs only.
#pragma once

#include "execution/execution.h"
#include "sphere/sphere_map.h"

#include <vector>

namespace koebe {

/// A surface with its map to the sphere.
struct LaidSurface {
    const Triangles& triangles;
    const Vertices& points;             ///< (V, 3) unit vectors
    const std::vector<char>& turned;    ///< (F) 1 for faces with the other orientation
    const std::vector<char>& on_loop;   ///< (V) 1 for vertices of loops
    const std::vector<Index>& polygon;  ///< (F) faces of one number are one polygon; empty: each face by itself
};

/// (3F, 2) UVs of the corners of all faces. All are multiples of 2^-23 and 32-bit floats. The two sides of a cut are
/// the same points of the continued pattern to the last bit.
///
/// equirectangular: u = (longitude + pi) / 2 pi, v = (latitude + pi / 2) / pi. The pattern has the period 1 along u. A
/// face across the cut goes on beyond 1, so u is in [0, 2). A corner at a pole has no longitude: it takes the mean of
/// its face's other two.
///
/// octahedral: the point over |x| + |y| + |z|, the upper half as |u'| + |v'| <= 1 in [-1, 1]^2, the lower faces folded
/// out over its sides, u = (1 + u') / 2, v = (1 + v') / 2. The cut runs from (0, 0, -1) to the four points of the
/// equator (+-1, 0, 0) and (0, +-1, 0), which are the middles of the square's sides. Beyond a side the pattern is
/// turned by half a turn round the side's middle. A face across the cut goes on beyond the square, from the place of
/// its own middle. join_polygon puts polygons together.
///
/// No flat face fits round a cone point (cone_points). So the layout moves a vertex of the face round it there, and its
/// neighbourhood by less and less. A straight side of a face is bent on the sphere, so some upright faces have flipped
/// UVs, mostly near poles. The layout moves their vertices one by one, each to where the worst face around it is best,
/// over more and more neighbours until no face is flipped. The points themselves stay. Vertices of loops move last.
/// @param report out
PlanarPoints sphere_layout(const LaidSurface& surface, SphereLayout layout, SphereLayoutReport& report,
                           const ExecutionContext& context);

}  // namespace koebe
