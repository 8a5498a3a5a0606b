// Triangles for the holes of a surface (paper, section 4.4): a fan on the surface, Delaunay patches in the plane.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "mesh/topology.h"
#include "planar/planar_mesh.h"

#include <optional>
#include <vector>

namespace koebe {

/// A disk of triangles; its first vertices are those of the loop, in the loop's order, then the new ones.
struct SurfacePatch {
    Vertices vertices;
    Triangles triangles;
};

/// Fan around the mean of the loop's vertices (paper, section 4.4).
/// The centre is finite, and inside the loop's bounding box, for all finite positions.
/// @param loop (m, 3) boundary loop, the surface on the left; the patch continues the surface's orientation
/// @return m + 1 vertices, m triangles
SurfacePatch fill_on_surface(const Vertices& loop);

/// Delaunay patch of a planar polygon: no boundary edge is split, edges match the polygon's near it and, unless the
/// options say otherwise, are nowhere longer than its mean edge.
/// @param polygon (m) simple, counter-clockwise (or clockwise: triangles are counter-clockwise in either case)
/// @throws InputError the polygon crosses itself or has coinciding points
PlanarMesh planar_patch(const VectorXcd& polygon);
PlanarMesh planar_patch(const VectorXcd& polygon, const PlanarMeshOptions& options);

struct FilledSurface {
    Vertices vertices;         ///< the input's, then one for each filled loop
    Triangles triangles;       ///< the input's, turned to one orientation, then those of the patches
    std::vector<Index> label;  ///< per face: -1 input, k the loop filled, by rank among the boundary loops
};

/// The loops to fill: the ranks given, sorted and once each, or all.
/// @throws InputError a rank that does not exist
std::vector<Index> chosen_ranks(const Surface& surface, const std::optional<std::vector<Index>>& loops);

/// The rank of the longest boundary loop, the first of equal ones: what stays open if only the holes are filled.
/// @param surface with one loop at least
Index longest_loop(const Vertices& vertices, const Surface& surface);

/// Fills boundary loops by fans on the surface.
/// @param loops ranks of the loops to fill, in the order of Surface::loops; all of them if absent
/// @throws InputError a rank that does not exist; TopologyError as analyze_surface
KOEBE_API FilledSurface fill_holes(const Vertices& vertices, const Triangles& triangles,
                                   const std::optional<std::vector<Index>>& loops = std::nullopt);

}  // namespace koebe
