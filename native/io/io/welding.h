// Vertices that lie in one place, of files that have a vertex several times.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "core/warning.h"

#include <optional>
#include <vector>

namespace koebe {

/// Joins vertices that lie close together. In the vertices' order, each joins the nearest one that was kept before it
/// and lies within the distance, or is kept itself. So no vertex moves farther than the distance, and a chain of near
/// vertices does not become one.
/// @param distance at least 0, in the vertices' unit, which are finite then. 0: equal coordinates; -0 is 0
/// @return (V) the kept vertex that each one is joined to: itself or an earlier one
KOEBE_API std::vector<Index> weld(const Vertices& vertices, double distance);

/// Warns of vertices of rims that lie where another one lies, as in soups, cracked solids and meshes with split
/// normals: closer than a hundredth of the rims' edges at both. The warning lists them, and says how many components
/// there are, how many if they were joined, and the least distance for weld().
/// @param triangles may be degenerate
KOEBE_API std::optional<Warning> coincident_vertices(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
