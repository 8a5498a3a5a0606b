// Makes cuts mirror images of each other, on surfaces that are their own mirror images.
#pragma once

#include "splitting/splitting.h"
#include "surface/mirror.h"

#include <vector>

namespace koebe {

/// Replaces the parts by those of one side and their mirror images. Takes the better side. A part on the plane stays
/// one part with its image. If the surface has no mirror, or the old parts are far better, they stay.
/// @return whether the parts are symmetric now
bool make_symmetric(const CutSurface& whole, const SplitOptions& options, const Mirror& mirror,
                    std::vector<PartPointer>& parts, ExecutionContext& context, SplitEffort& effort);

/// Whether symmetric parts cost at most twice as much as others.
bool is_worth_symmetry(const CutSurface& whole, const SplitOptions& options, const std::vector<PartPointer>& symmetric,
                       const std::vector<PartPointer>& others);

/// The faces of each connected piece on one side of the plane.
std::vector<std::vector<Index>> faces_of_sides(const CutSurface& whole, const Mirror& mirror);

/// Half-edges (3F) of the whole along which tubes should be opened, so that slits are mirror images: half-edges on the
/// plane, and the images of slits.
/// @param opened (3F) 1 for half-edges of slits
std::vector<char> mirrored_slits(const CutSurface& whole, const Mirror& mirror, const std::vector<char>& opened);

}  // namespace koebe
