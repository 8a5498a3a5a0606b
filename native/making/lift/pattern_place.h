// Where a drawing or a mesh is placed in a flat domain.
#pragma once

#include "lift/flat_sheet.h"
#include "planar/plane_box.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe {

struct PatternPlace {
    bool in_disk = false;             ///< the domain is the disk in the unit square, or a half of a sphere
    bool on_sphere = false;           ///< the sheet is a chart of a sphere
    std::optional<double> size = {};  ///< width on the surface, in the mean; none: nine tenths of the room
    int repeats = 1;                  ///< copies round a ring, or along the first period of a torus
    double turn = 0.0;                ///< degrees counter-clockwise
};

/// The turn as a unit number: quarter turns to the last bit.
Complex unit_turn(double degrees);

/// The box of a pattern keeps its aspect. Its middle is put in the middle of the domain's box, or in the middle of each
/// copy's share of this box. In a disk the box's corners reach to nine tenths of the radius; else it takes nine tenths
/// of the room in width or height. On a sphere it lies around the middle of the chart, as in a disk.
struct PlacedFrame {
    double width = 0.0;  ///< in the UVs
    double scale = 1.0;  ///< length on the surface of a length in the UVs, in the mean; of a sphere in the middle
    std::vector<Complex> centres;  ///< of the copies
};

/// @param aspect height over width @param what the pattern's word in errors: drawing or mesh
/// @param taken share of the room in width or height, without a size
/// @throws InputError copies do not fit side by side; repeats where the domain does not repeat
PlacedFrame placed_frame(const FlatSheet& sheet, double aspect, const PatternPlace& place, const std::string& what,
                         double taken = 0.9);

}  // namespace koebe
