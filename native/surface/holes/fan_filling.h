// Fills the holes of a surface (paper, section 4.4): a fan on the surface, Delaunay patches in the plane.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "core/warning.h"
#include "mesh/topology.h"
#include "planar/planar_mesh.h"

#include <optional>
#include <vector>

namespace koebe {

/// A disk of triangles. Its first vertices are the loop's in the loop's order, then come the new ones.
struct SurfacePatch {
    Vertices vertices;
    Triangles triangles;
};

/// Fan around the mean of the loop's vertices (paper, section 4.4).
/// The centre is finite, and inside the loop's bounding box, for all finite positions.
/// @param loop (m, 3) boundary loop, the surface on the left; the patch continues the surface's orientation
/// @return m + 1 vertices, m triangles
SurfacePatch fill_on_surface(const Vertices& loop);

/// Delaunay patch of a planar polygon. No boundary edge is split. Edges match the polygon's edges nearby and, unless
/// the options say otherwise, are nowhere longer than its mean edge.
/// @param polygon (m) simple, of either orientation; triangles are always counter-clockwise
/// @throws InputError the polygon crosses itself or has coinciding points
PlanarMesh planar_patch(const VectorXcd& polygon);
PlanarMesh planar_patch(const VectorXcd& polygon, const PlanarMeshOptions& options);

struct FilledSurface {
    Vertices vertices;         ///< the input's, then one for each filled loop
    Triangles triangles;       ///< the input's as they are, then the patches', oriented as most of the input's
    std::vector<Index> label;  ///< per face: -1 in the input, k in the patch of the loop of rank k
    std::vector<Warning> warnings = {};  ///< of faces of the input with the other orientation
};

/// The ranks of the loops to fill: the given ranks, sorted and without duplicates, or all.
/// @throws InputError a rank that does not exist
std::vector<Index> chosen_ranks(const Surface& surface, const std::optional<std::vector<Index>>& loops);

/// The rank of the longest boundary loop, the first of equal ones: the loop that stays open when only holes are filled.
/// @param surface with at least one loop
Index longest_loop(const Vertices& vertices, const Surface& surface);

/// Warns of faces that have another orientation than the patches, if any. @param faces ascending
std::vector<Warning> filling_warnings(const std::vector<Index>& faces);

/// Fills boundary loops by fans on the surface.
/// @param loops ranks of the loops to fill, in the order of Surface::loops; all loops if absent
/// @throws InputError a rank that does not exist; TopologyError as analyze_surface
KOEBE_API FilledSurface fill_holes(const Vertices& vertices, const Triangles& triangles,
                                   const std::optional<std::vector<Index>>& loops = std::nullopt);

}  // namespace koebe
