// Places an SVG drawing in a flat domain.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"
#include "lift/svg_drawing.h"

#include <optional>
#include <vector>

namespace koebe {

struct DrawingPlace {
    bool in_disk = false;             ///< the domain is the disk in the unit square
    std::optional<double> size = {};  ///< width on the surface, in the mean; none: nine tenths of the room
    int repeats = 1;                  ///< copies round a ring, or along the first period of a torus
    double turn = 0.0;                ///< degrees counter-clockwise
    bool cut_out = false;             ///< without holes in outlines, and the outlines in these
};

struct PlacedDrawing {
    std::vector<DrawnOutline> outlines;
    double size = 0.0;                ///< as used
    Index islands = 0;                ///< holes left out by `cut_out`
    std::vector<Index> island_faces;  ///< where these begin, ascending
};

/// The drawing is turned, and its box keeps its aspect. Its middle is put in the middle of the domain's box, or in the
/// middle of each copy's share of this box. In a disk the box's corners reach to nine tenths of the radius; else it
/// takes nine tenths of the room in width or height. Paths are united (planar/filled_paths.h). Curves become polygons
/// that lie within a thousandth of the drawing's size, and within a twentieth of the mesh's mean edge.
/// @throws InputError copies do not fit side by side; a drawing of over 200,000 corners; repeats where the domain does
/// not repeat
PlacedDrawing placed_drawing(const FlatSheet& sheet, const SvgDrawing& drawing, const DrawingPlace& place);

}  // namespace koebe
