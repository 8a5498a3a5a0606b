// Triangulating a planar region without touching its boundary polygons.
#pragma once

#include "core/types.h"

#include <limits>
#include <vector>

namespace koebe {

struct PlanarMeshOptions {
    /// Longest edge wanted, in the unit of the points.
    double longest = std::numeric_limits<double>::infinity();
    /// By how much the edge length may grow per unit of distance from the boundary, dimensionless, > 0.
    double gradation = 0.25;
    /// Rounds of smoothing; each ends with a new Delaunay triangulation.
    int smoothing = 8;
};

struct PlanarMesh {
    VectorXcd points;     ///< the polygons' points first, in their order, then the interior ones
    Triangles triangles;  ///< counter-clockwise; beside the middle of a chord, up to the rounding of the middle
};

/// Constrained Delaunay triangulation of the region inside the first polygon and outside the others, with interior
/// points such that edges match the length of the boundary edges nearby: size(x) = min(longest,
/// min_v (h_v + gradation |x - v|)) over the boundary vertices v with mean edge length h_v.
///
/// Points are circumcentres of triangles that are too large (Chew 1993), left out where they would encroach upon a
/// boundary edge, so that no boundary edge is ever split; then they are moved to the size-weighted centroids of
/// their stars (Du, Faber, Gunzburger 1999). Predicates are exact (CGAL), reruns are bit-identical.
///
/// No inner edge joins two boundary vertices (it would be cut in the middle): where the mesh is glued to another one,
/// that one may have an edge between the two.
///
/// @param polygons closed, simple, disjoint, of any orientation, at least three points each; the first encloses
///        the others
/// @throws InputError a polygon crosses itself or another one, or has coinciding points
PlanarMesh planar_mesh(const std::vector<VectorXcd>& polygons, const PlanarMeshOptions& options = {});

}  // namespace koebe
