// A flat pattern as SVG: a document for each page, in millimetres.
#pragma once

#include "core/api.h"
#include "flatten/pattern.h"

#include <string>
#include <vector>

namespace koebe {

/// Width, height and viewBox say millimetres, so that each page prints in real size. A page has its frame, its number
/// and a bar of 50 mm to check the print. Pages of one sheet show each other's margins; frames are laid edge to edge,
/// and joints are named by the pages that they join.
KOEBE_API std::vector<std::string> pattern_svg(const Pattern& pattern);

}  // namespace koebe
