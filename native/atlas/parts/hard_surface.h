// Takes the flat and rolled regions of hard surfaces out of a mesh, before anything else is cut.
#pragma once

#include "cut/open_surface.h"
#include "execution/execution.h"
#include "parts/flat_part.h"
#include "parts/parts.h"

#include <vector>

namespace koebe {

/// @param vertices, triangles of the input @param scaled the vertices, so that all areas sum to 1
/// @param connected the input's surfaces, not opened (OpenOptions::open). Hard surfaces lose their parts (unfolding.h)
/// @param parts takes the hard parts, by numbers of the input
/// @return the other faces, opened. Its handles are those of all surfaces
OpenedSurface opened_without_hard_parts(const Vertices& vertices, const Triangles& triangles, const Vertices& scaled,
                                        OpenedSurface connected, const PartsOptions& options,
                                        std::vector<FlatPart>& parts, ExecutionContext& context);

/// Names faces and vertices by the input. @param parts by numbers of the piece
void name_by_input(const SurfacePiece& piece, const std::vector<double>& show, std::vector<FlatPart>& parts);

}  // namespace koebe
