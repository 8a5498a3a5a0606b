// Darts cut into all parts of a surface, round by round, as long as they pay.
#pragma once

#include "even/even_map.h"
#include "execution/execution.h"
#include "flat/flat_part.h"

#include <vector>

namespace koebe {

/// A flat part and the circles and lines on which its loops are held.
struct HeldPart {
    FlatPart flat;
    std::vector<RoundLoop> round;
};

/// The part for make_even, which moves its points. @param round as in HeldPart
FlatSurface flat_surface(FlatPart& flat, std::vector<RoundLoop>& round);

/// Whether loops stay apart however their points are rounded: parts are turned and scaled before they are stored. The
/// rounding is coarser than the rounding of stored UVs.
bool survives_storing(const FlatPart& flat);

/// Where darts end: anywhere, or in faces whose energy is above tuning::strained.
enum class DartTips { anywhere, strained };

/// Each round opens the most promising darts (darts.h) and relaxes their parts. Darts that released more energy than
/// they cost stay. The other darts are closed again. On a surface that is its own mirror image darts come in pairs:
/// both stay, or both are closed.
/// @param parts relaxed for this E
/// @param price price, in energy, of a dart as long as the root of the surface's area
void cut_darts(std::vector<HeldPart>& parts, DartTips tips, double even, double price, int threads,
               ExecutionContext& context);

}  // namespace koebe
