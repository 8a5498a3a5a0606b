// Triangles for the holes of a surface that continue its curvature [Liepa 2003].
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "holes/fan_filling.h"

#include <optional>
#include <vector>

namespace koebe {

/// Fills boundary loops by CGAL's triangulation, refinement and fairing: a triangulation of least dihedral angles and
/// area, refined to the edge lengths around the hole, its new vertices moved to where the Laplacian of third order is
/// 0, with the loop, the tangent planes and the curvature there given [Botsch and Kobbelt 2004]. The vertices up to two
/// edges from the loop give these. A loop of more than 277 edges gets a coarser patch, of 10,000 triangles or 4 for
/// each edge, by the Laplacian of second order, with the loop and the tangent planes given.
/// @param loops ranks of the loops to fill, in the order of Surface::loops; all of them if absent
/// @return as fill_holes: the input's vertices and faces first, then those of the patches, loop by loop
/// @throws InputError a rank that does not exist, a loop without extent, one that meets itself, one that CGAL cannot
///         triangulate (elements: its vertices); SolverError the fairing failed; TopologyError as analyze_surface
KOEBE_API FilledSurface fill_and_fair_holes(const Vertices& vertices, const Triangles& triangles,
                                            const std::optional<std::vector<Index>>& loops = std::nullopt);

}  // namespace koebe
