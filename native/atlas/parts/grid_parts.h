// Parts whose faces are a grid of quadrilaterals become rectangles with straight rows.
#pragma once

#include "parts/flat_part.h"

#include <vector>

namespace koebe {

/// Lays a part out as a rectangle if its polygons are the m by n cells of a grid: column i is as wide, and row j as
/// high, as their edges are long in the mean. The rectangle lies along the axes.
/// @param any true: whatever the stretch. false: only if the surface is nearly developable, so that angles bend little
/// and texels stay even. A part that keeps all lengths, such as a plate or a cone, keeps its shape, unless the
/// rectangle keeps angles as well @param noise up to which a part keeps its lengths (PlanarRegions)
void rectify_grids(std::vector<FlatPart>& parts, bool any, double noise = 0.0);

}  // namespace koebe
