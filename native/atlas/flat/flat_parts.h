// Lays the parts of a piece flat. Each part is checked as it will be stored, and cut in two if it has flaws.
#pragma once

#include "flat/flat_part.h"
#include "splitting/mirror_symmetry.h"

#include <optional>
#include <vector>

namespace koebe {

/// The flaws of flat parts as they are stored.
struct Flaws {
    double lost = 0.0;    ///< area of faces stored without area, in parts that lose more than the share allowed
    Index turned = 0;     ///< number of faces turned over, plus parts whose boundary crosses itself
    double spoilt = 0.0;  ///< damage to texels and angles by repairs, in the area whose loss costs as much

    bool broken() const { return lost > 0.0 || turned > 0; }
    bool any() const { return broken() || spoilt > 0.0; }
};

struct FlatParts {
    std::vector<FlatPart> parts;
    Flaws flaws;
};

/// Lays parts flat, several at a time. The parts of a mirror-symmetric piece are laid flat one after the other, because
/// each part takes the mirror images of earlier slits as its own slits. The splitting judged each part in 64 bits, with
/// its flipped faces. A part that loses much area or overlaps as it is stored is now cut in two across its length, as
/// often as such a cut helps.
/// @param parts released one by one
FlatParts flat_parts(const CutSurface& whole, const Mirror& mirror, std::vector<PartPointer>& parts,
                     const FlatOptions& options, int threads, ExecutionContext& context, SplitEffort& effort);

/// The whole piece as one map, if this map is usable and clearly better than the parts: coarse or crumpled surfaces
/// have less angle error without cuts. It may be less even only as far as its angles and the number of parts pay for
/// it. If its angle error is only a little less, the parts are polished with their boundaries held.
/// @param whole has a boundary @param root the map of the whole piece by which it was split, or null
/// @return no part if the parts are better
std::optional<FlatPart> better_as_one(const CutSurface& whole, const Part* root, FlatParts& parts, double part_price,
                                      ExecutionContext& context);

}  // namespace koebe
