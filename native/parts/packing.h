// Rectangles into the unit square.
#pragma once

#include <array>
#include <vector>

namespace koebe {

struct Box {
    double width = 0.0, height = 0.0;
};

struct PackedBoxes {
    std::vector<std::array<double, 2>> corners;  ///< lower left, in the boxes' unit
    double side = 1.0;                           ///< of the square that holds them, margins included
};

/// Puts boxes into as small a square as it finds: for a row of widths, the highest first, each where it comes lowest on
/// the skyline (stb_rect_pack). @param margin between boxes and round them, as a share of the square's side
PackedBoxes pack_boxes(const std::vector<Box>& boxes, double margin);

}  // namespace koebe
