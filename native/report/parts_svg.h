// A picture of the parts in the unit square.
#pragma once

#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

/// One path of triangles for each part, in a colour of its own; v points up.
/// @param corner_uv (3F, 2) @param part (F), -1: not drawn
std::string parts_svg(const PlanarPoints& corner_uv, const std::vector<Index>& part);

}  // namespace koebe
