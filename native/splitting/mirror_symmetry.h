// Cuts that are each other's mirror images, of surfaces that are.
#pragma once

#include "splitting/splitting.h"
#include "surface/mirror.h"

#include <vector>

namespace koebe {

/// Parts whose cuts are each other's mirror images: those of one side and their images, whichever side is the better.
/// What lies on the plane stays in one part with its image. The parts stay as they are if the surface has no mirror, or
/// if they are better by far. @return whether they are symmetric now
bool make_symmetric(const CutSurface& whole, const SplitOptions& options, const Mirror& mirror,
                    std::vector<PartPointer>& parts, ExecutionContext& context, SplitEffort& effort);

/// Half-edges (3F) of the whole along which tubes are to be opened so that slits are mirror images: those on the plane,
/// and the images of those where parts were opened.
/// @param opened (3F) 1 for half-edges of slits
std::vector<char> mirrored_slits(const CutSurface& whole, const Mirror& mirror, const std::vector<char>& opened);

}  // namespace koebe
