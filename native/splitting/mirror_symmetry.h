// Surfaces that are their own mirror images, and cuts that are too.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// Faces and their mirror images. Of quadrilaterals the diagonals need not correspond: polygons do.
struct Mirror {
    std::vector<Index> group;  ///< (F) the polygon of each face, from 0 on
    std::vector<Index> image;  ///< of each polygon; empty: the surface is no mirror image of itself
    std::vector<double> side;  ///< of each polygon: its middle's signed distance from the plane
};

/// Looks for a plane through the middle of the surface, across one of its axes or of the coordinates': every polygon's
/// middle has a mirror image that is the middle of another, to 1e-5 of the root of the area.
Mirror find_mirror(const CutSurface& whole);

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
