// Fills the holes of a surface so that its curvature continues [Liepa 2003].
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "holes/fan_filling.h"

#include <optional>
#include <vector>

namespace koebe {

/// Fills boundary loops by CGAL's triangulation, refinement and fairing. The triangulation has least dihedral angles
/// and area. It is refined to the edge lengths around the hole. Fairing moves the new vertices to where the Laplacian
/// of third order is 0, with loop, tangent planes and curvature given [Botsch and Kobbelt 2004] by the vertices up to
/// two edges from the loop. A loop of more than 277 edges gets a coarser patch, of 10,000 triangles or 4 for each edge,
/// by the Laplacian of second order, with loop and tangent planes given.
/// @param loops ranks of the loops to fill, in the order of Surface::loops; all loops if absent
/// @return as fill_holes: the vertices and faces of the input, then the vertices and faces of the patches, loop by loop
/// @throws InputError a rank that does not exist, a loop without extent, a loop that meets itself or that CGAL cannot
/// triangulate (elements: its vertices); SolverError the fairing failed; TopologyError as analyze_surface
KOEBE_API FilledSurface fill_and_fair_holes(const Vertices& vertices, const Triangles& triangles,
                                            const std::optional<std::vector<Index>>& loops = std::nullopt);

}  // namespace koebe
