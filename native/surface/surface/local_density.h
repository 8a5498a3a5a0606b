// What lies round each vertex of a surface, per area.
#pragma once

#include "core/types.h"

namespace koebe {

/// The amounts at vertices over their areas, both averaged within about a radius, by diffusion.
/// @param vertices (V, 3) @param triangles (F, 3) @param amount, area (V) @param radius in the surface's unit
/// @return (V) in the unit of the amount over that of the area
VectorXd local_density(const Vertices& vertices, const Triangles& triangles, VectorXd amount, VectorXd area,
                       double radius);

}  // namespace koebe
