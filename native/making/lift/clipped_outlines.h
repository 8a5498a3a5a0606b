// Outlines that go on beyond holes and rims: what they take of the surface.
#pragma once

#include "lift/overlay.h"

#include <vector>

namespace koebe {

/// An overlay of a filled sheet, and what it makes of the surface.
struct ClippedOverlay {
    Overlay overlay;
    Index outlines = 0;  ///< those with a part on the surface, each with its holes
    Index holes = 0;     ///< if outlines are cut out, there are so many more loops, and the Euler characteristic is as
                         ///< much lower
};

/// Draws outlines into a filled sheet. Outlines are left out as `at_border` if the surface would fall apart where they
/// are cut out, or if they touch a hole or a rim in a point only.
/// @param cut_out whether the faces inside outlines go
ClippedOverlay draw_clipped_outlines(const FlatSheet& filled, std::vector<DrawnOutline> outlines,
                                     const std::vector<FlatSheet>& charts, bool cut_out);

}  // namespace koebe
