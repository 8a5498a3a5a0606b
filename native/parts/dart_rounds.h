// Darts cut into all parts of a surface, round by round, as long as they pay.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"
#include "relax/even_map.h"

#include <vector>

namespace koebe {

/// A flat part and the circles and lines on which its loops are held.
struct HeldPart {
    FlatPart flat;
    std::vector<RoundLoop> round;
};

/// Whether loops stay apart when their points are rounded, more coarsely than they will be stored.
bool survives_storing(const FlatPart& flat);

/// Each round opens the darts that promise most (darts.h), relaxes their parts, and keeps the darts that released more
/// energy than they cost; the others are closed again. On a mirror image of itself darts come in pairs, and a pair is
/// kept or closed as one.
/// @param parts relaxed for this E
/// @param price of a dart as long as the root of the surface's area, in energy
void cut_darts(std::vector<HeldPart>& parts, double even, double price, int threads, ExecutionContext& context);

}  // namespace koebe
