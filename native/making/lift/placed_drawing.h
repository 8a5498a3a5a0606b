// Places an SVG drawing in a flat domain.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"
#include "lift/pattern_place.h"
#include "svg/svg_drawing.h"

#include <optional>
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
/// @param filled the sheet filled (filled_sheet.h), or the sheet itself: where outlines are
/// @param cut_out without holes in outlines, and the outlines in these
/// @param least_bridge if given, areas that are nearer than this to the border are made smaller about their middle,
/// until they fit: in the unit of the vertices
/// @throws InputError as placed_frame; a drawing of over 200,000 corners
PlacedDrawing placed_drawing(const FlatSheet& sheet, const FlatSheet& filled, const SvgDrawing& drawing,
                             const PatternPlace& place, bool cut_out, std::optional<double> least_bridge = {});

}  // namespace koebe
