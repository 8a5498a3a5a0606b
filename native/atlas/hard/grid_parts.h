// Parts whose faces are a grid of quadrilaterals become rectangles with straight rows.
#pragma once

#include "flat/flat_part.h"
#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

/// Lays a part out as a rectangle if its polygons are the m by n cells of a grid: column i is as wide, and row j as
/// high, as their edges are long in the mean. The rectangle lies along the axes.
/// @param any true: whatever the stretch. false: only if the surface is nearly developable, so that angles bend little
/// and texels stay even. A part that keeps all lengths, such as a plate or a cone, keeps its shape, unless the
/// rectangle keeps angles as well @param noise up to which a part keeps its lengths (PlanarRegions)
void rectify_grids(std::vector<FlatPart>& parts, bool any, double noise = 0.0);

/// Lays a ring or a tube of quadrilaterals out as a rectangle, as a person does with a torus and a pipe: opened along
/// its shortest lines, and across into equal pieces if it is too long. Only a ring with four cells at each vertex, or
/// such a tube, that is curved in both directions, and bends little in a rectangle.
/// @param hard_angle in degrees: one that is bent by more than twice this angle at an edge is left
/// @param longest side of a piece, in the unit of the surface @return the rectangles; empty: it is no such grid
std::vector<FlatPart> rolled_grid(const CutSurface& surface, double hard_angle, double longest);

}  // namespace koebe
