// Cuts that were decided on coarse parts, made in the fine parts.
#pragma once

#include "parts/coarse_parts.h"
#include "parts/flat_part.h"

#include <vector>

namespace koebe {

/// How a carried piece lies.
enum class Carried {
    placed,  ///< as the relaxed coarse piece
    cut,     ///< as it lay in the part, its cuts a little open
    whole,   ///< it is the whole part: its cuts cannot be made
};

struct CarriedParts {
    std::vector<FlatPart> parts;
    std::vector<Carried> how;  ///< (parts)
};

/// Cuts the fine parts along the paths near their coarse cuts (carried_paths.h). Each piece takes its place in the
/// plane from the relaxed coarse piece: vertices on paths keep their share of the chain's length, the others their
/// place in a coarse face. If that is not one to one, also as stored, the piece stays where it was in the part.
/// @param before coarse parts of the fine ones, uncut @param after the same parts, cut and relaxed
/// @return the pieces of the first part, of the second, and so on.
CarriedParts carried(const std::vector<FlatPart>& fine, const CoarseParts& before, const std::vector<FlatPart>& after,
                     const ExecutionContext& context);

}  // namespace koebe
