// A coarse surface that is its own mirror image, whatever the triangulation of the fine one.
#pragma once

#include "splitting/coarse_surface.h"
#include "surface/mirror_plane.h"

#include <optional>

namespace koebe {

/// Makes the faces on one side of a plane coarse, and doubles them: their border goes into the plane, and the other
/// side is their mirror image. A vertex of the image is the fine vertex near it, on a boundary if it is on one itself.
/// @param whole nearly its own mirror image @param image (V) exact mirror images of vertices, -1 for none; empty:
/// unknown
/// @param faces about so many in all
/// @return no value if that is no surface of the same topology, or if vertices or loops do not correspond
std::optional<CoarseSurface> mirrored_coarse_surface(const CutSurface& whole, const MirrorPlane& plane,
                                                     const std::vector<Index>& image, Index faces,
                                                     ExecutionContext& context);

}  // namespace koebe
