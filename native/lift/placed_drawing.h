// Places an SVG drawing in a flat domain.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"
#include "lift/pattern_place.h"
#include "lift/svg_drawing.h"

#include <vector>

namespace koebe {

struct PlacedDrawing {
    std::vector<DrawnOutline> outlines;
    double size = 0.0;                ///< as used
    Index islands = 0;                ///< holes left out where outlines are cut out
    std::vector<Index> island_faces;  ///< where these begin, ascending
};

/// The drawing is placed by placed_frame. Paths are united (planar/filled_paths.h). Curves become polygons that lie
/// within a thousandth of the drawing's size, and within a twentieth of the mesh's mean edge.
/// @param cut_out without holes in outlines, and the outlines in these
/// @throws InputError as placed_frame; a drawing of over 200,000 corners
PlacedDrawing placed_drawing(const FlatSheet& sheet, const SvgDrawing& drawing, const PatternPlace& place,
                             bool cut_out);

}  // namespace koebe
