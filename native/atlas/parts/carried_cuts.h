// Cuts that were decided on coarse parts, made in the fine parts.
#pragma once

#include "parts/coarse_parts.h"
#include "parts/flat_part.h"

#include <vector>

namespace koebe {

struct CarriedParts {
    std::vector<FlatPart> parts;
    std::vector<char> placed;  ///< (parts) 1: it lies as the relaxed coarse piece does. 0: as it was before
};

/// Each chain of coarse edges along which the coarse parts were cut becomes a short path of edges of the fine part near
/// it. Paths do not meet, except at their ends, do not touch the boundary between them, and spare polygons. The path of
/// a mirror image is the image of the path. Then the fine part is cut, and each piece takes its place in the plane from
/// the relaxed coarse piece: vertices on paths keep their share of the chain's length, the others their place in a
/// coarse face. If that is not one to one, the piece stays where it was in the part, its cuts a little open.
/// @param before coarse parts of the fine ones, uncut @param after the same parts, cut and relaxed
/// @return the pieces of the first part, of the second, and so on. A part whose cuts cannot be made stays whole
CarriedParts carried(const std::vector<FlatPart>& fine, const CoarseParts& before, const std::vector<FlatPart>& after,
                     const ExecutionContext& context);

}  // namespace koebe
