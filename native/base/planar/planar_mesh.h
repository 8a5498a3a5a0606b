// Triangulates a planar region without changing its boundary polygons.
#pragma once

#include "core/types.h"

#include <limits>
#include <vector>

namespace koebe {

struct PlanarMeshOptions {
    /// Longest edge, in the unit of the points.
    double longest = std::numeric_limits<double>::infinity();
    /// Growth of the edge length per distance from the boundary, dimensionless, > 0.
    double gradation = 0.25;
    /// Rounds of smoothing; each ends with a new Delaunay triangulation.
    int smoothing = 8;
    /// No interior points, and inner edges may join two boundary vertices.
    bool bare = false;
};

struct PlanarMesh {
    VectorXcd points;     ///< the polygons' points in their order, then the interior points
    Triangles triangles;  ///< counter-clockwise; beside the middle of a chord up to its rounding
};

/// Constrained Delaunay triangulation of the region inside the first polygon and outside the others. Edges match the
/// boundary edges nearby: size(x) = min(longest, min_v (h_v + gradation |x - v|)) over the boundary vertices v with
/// mean edge length h_v.
///
/// Interior points are circumcentres of triangles that are too large (Chew 1993). A point that would encroach upon a
/// boundary edge is left out. So no boundary edge is ever split. Then they move to the size-weighted centroids of their
/// stars (Du, Faber, Gunzburger 1999). Predicates are exact (CGAL), reruns are bit-identical.
///
/// No inner edge joins two boundary vertices: such edges are cut in the middle, as a mesh glued to this one may have an
/// edge between the same two.
///
/// @param polygons closed, simple, disjoint, of any orientation, at least three points each; the first encloses the
/// others
/// @throws InputError a polygon crosses itself or another, or has coinciding points
PlanarMesh planar_mesh(const std::vector<VectorXcd>& polygons, const PlanarMeshOptions& options = {});

}  // namespace koebe
