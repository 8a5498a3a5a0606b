// Where a surface is hollow.
#pragma once

#include "part_maps/part_mesh.h"

namespace koebe {

/// Mean curvature at the scale of a radius: the bends of the edges, averaged within about the radius by diffusion.
/// Positive where the surface bulges, negative where it is hollow. Unit: the inverse of the surface's unit. The outer
/// side is the side on which most of the area faces away from the surface's middle.
/// @param radius in the surface's unit @return (V)
VectorXd mean_curvature(const CutSurface& whole, double radius);

}  // namespace koebe
