// Takes the flat and rolled regions of hard surfaces out of a mesh, before anything else is cut.
#pragma once

#include "cut/open_surface.h"
#include "execution/execution.h"
#include "flat/divided_faces.h"
#include "flat/flat_part.h"
#include "hard/unfolding.h"
#include "parts/parts.h"

#include <vector>

namespace koebe {

/// Whether pieces may be unfolded true to size: E is not 0, and none of round loops, slits, no hard surfaces is asked
/// for.
bool may_unfold(const PartsOptions& options);

UnfoldOptions unfolding_of(const PartsOptions& options);

struct HardSurfaces {
    std::vector<FlatPart> parts;  ///< the hard parts, by numbers of the input
    OpenedSurface rest;           ///< the other faces, opened. Its handles are those of all surfaces
    double noise = 0.0;           ///< the largest of the surfaces (UnfoldedParts)
};

/// @param vertices of the input @param scaled the vertices, so that all areas sum to 1
/// @param connected the input's surfaces, not opened (OpenOptions::open). Hard surfaces lose their parts (unfolding.h)
HardSurfaces opened_without_hard_parts(const Vertices& vertices, const DividedFaces& faces, const Vertices& scaled,
                                       OpenedSurface connected, const PartsOptions& options, ExecutionContext& context);

/// Names elements by those from which the piece's came. @param parts by numbers of the piece
void name_by_source(const SurfacePiece& piece, std::vector<FlatPart>& parts);

}  // namespace koebe
