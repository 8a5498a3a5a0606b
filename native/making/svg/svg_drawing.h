// Reads the shapes of an SVG file (W3C, SVG 1.1 Second Edition), by svgpp and RapidXML.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

/// A path, rectangle, circle, ellipse or polygon of a drawing. The y axis points up.
struct SvgPath {
    bool even_odd = false;  ///< fill rule; else nonzero
    /// Closed curves of cubic Bezier segments: a point, then three for each segment. The last one is the first again.
    std::vector<std::vector<Complex>> curves;
    std::vector<Index> clips;  ///< of the drawing: only what lies in all of them is inside

    bool operator==(const SvgPath&) const = default;
};

struct SvgDrawing {
    std::vector<SvgPath> paths;
    std::vector<std::vector<SvgPath>> clips;  ///< clip paths and masks: the union of the paths of each one
    int open = 0;                             ///< curves that do not close, left out
    std::vector<std::string> not_drawn;       ///< names of elements that are not drawn or do not cut: text, image, mask
    Complex low{0.0, 0.0}, high{0.0, 0.0};    ///< corners of a box around what is left of all control points
};

/// What a browser would show is drawn: styles, uses, symbols, switches and viewports are resolved (svg_document.h).
/// Transforms are applied. Colours are ignored: each closed curve that is filled or stroked is an outline. Clip paths,
/// and masks of plain white shapes, cut: `not_drawn` names the others.
/// @param bytes of the file
/// @throws InputError it is not an SVG, or damaged; a number is not finite; elements are nested more than a hundred
/// deep; there are over a million curve segments; there is no closed curve; clips leave nothing
KOEBE_API SvgDrawing parse_svg(std::string bytes);

/// The curves as polygons that lie at most a tolerance from them, without the point that closes them.
std::vector<std::vector<Complex>> flattened(const SvgPath& path, double tolerance);

}  // namespace koebe
