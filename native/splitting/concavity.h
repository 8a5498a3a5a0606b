// Where a surface is hollow.
#pragma once

#include "evenness/part_mesh.h"

namespace koebe {

/// Mean curvature at the scale of a radius, by the bends of the edges, averaged over the vertices within about the
/// radius by diffusion: above 0 where the surface bulges, below 0 where it is hollow, in the inverse of the surface's
/// unit. The side to which most of its area looks away from its middle is the outer one.
/// @param radius in the surface's unit @return (V)
VectorXd mean_curvature(const CutSurface& whole, double radius);

}  // namespace koebe
