// Draws a fundamental domain of a Schottky group, and the circles of its copies.
#pragma once

#include "schottky/schottky_map.h"

#include <string>

namespace koebe {

/// Draws the faces in the unit square's scale, the handles' circles, and the images of these under words of up to three
/// generators, which bound the copies.
std::string schottky_svg(const SchottkyResult& result);

}  // namespace koebe
