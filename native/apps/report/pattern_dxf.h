// A flat pattern as DXF, for cutters and CAD.
#pragma once

#include "core/api.h"
#include "flatten/pattern.h"

#include <string>

namespace koebe {

/// AutoCAD R12: POLYLINE, TEXT and nothing else, in millimetres. Sheets lie side by side, and pieces are whole on them.
/// Layers: CUT, SEAM, MARK, TEXT, and PAGE for the frames of pages.
KOEBE_API std::string pattern_dxf(const Pattern& pattern);

}  // namespace koebe
