// The parts of a piece, flat: each is looked at as it will be stored, and cut in two where it has come out badly.
#pragma once

#include "parts/flat_part.h"
#include "splitting/mirror_symmetry.h"

#include <optional>
#include <vector>

namespace koebe {

/// What is wrong with flat parts as they are stored.
struct Flaws {
    double lost = 0.0;    ///< area of faces without area, of parts where it is more than a part may lose
    Index turned = 0;     ///< faces turned over, and parts whose boundary crosses itself
    double spoilt = 0.0;  ///< area that repairs have cost texels or angles as much as if it were lost

    bool broken() const { return lost > 0.0 || turned > 0; }
    bool any() const { return broken() || spoilt > 0.0; }
};

struct FlatParts {
    std::vector<FlatPart> parts;
    Flaws flaws;
};

/// Side by side; of a mirror image one after the other, as each slit follows those before it. A part is judged by a map
/// whose flipped faces have not been turned back, and by 64-bit numbers; one of which much is lost or overlaps when it
/// lies as it is stored is cut in two across its length, as often as that helps.
/// @param parts let go of, one by one
FlatParts flat_parts(const CutSurface& whole, const Mirror& mirror, std::vector<PartPointer>& parts,
                     const FlatOptions& options, int threads, ExecutionContext& context, SplitEffort& effort);

/// A whole piece as one map, where that is usable and clearly better than its parts: coarse or crumpled
/// surfaces have less angle error without cuts. Where it bends a little less, the parts are polished, their boundaries
/// held.
/// @param whole with a boundary @param root the map of the whole piece by which it was split; none if there is none
/// @return no part if the parts are better
std::optional<FlatPart> better_as_one(const CutSurface& whole, const Part* root, FlatParts& parts,
                                      ExecutionContext& context);

}  // namespace koebe
