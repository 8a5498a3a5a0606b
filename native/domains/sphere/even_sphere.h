// Makes a map to the sphere more even, from conformal to true to size.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "surface/periodic_surface.h"

namespace koebe {

/// Minimizes E_t of even/even_map.h, from the surface's faces to the flat faces on the sphere
/// (sphere/elastic_sphere.h). The surface is scaled to the area of the map. At first sizes are wanted that are near the
/// present ones (Liu, Ye, Ni and Fu 2018). Vertices of loops stay.
/// @param points (V, 3) unit vectors @param even E, above 0 to 1
/// @return false, with the points as they were, if the map has faces that are not upright, or none that moves
/// @throws Cancelled
bool make_sphere_even(const PeriodicSurface& domain, double even, Vertices& points, const ExecutionContext& context);

}  // namespace koebe
