// The parts of a piece, flat: each is looked at as it will be stored, and cut in two where it has come out badly.
#pragma once

#include "parts/flat_part.h"
#include "parts/mirror_symmetry.h"

#include <vector>

namespace koebe {

/// Side by side; of a mirror image one after the other, as each slit follows those before it. A part is judged by a map
/// whose flipped faces have not been turned back, and by 64-bit numbers; one of which much is lost or overlaps when it
/// lies as it is stored is cut in two across its length, as often as that helps.
/// @param parts let go of, one by one
std::vector<FlatPart> flat_parts(const CutSurface& whole, const Mirror& mirror, std::vector<PartPointer>& parts,
                                 const FlatOptions& options, int threads, ExecutionContext& context,
                                 SplitEffort& effort);

}  // namespace koebe
