// Flipped faces of a map to the sphere turned back.
#pragma once

#include "execution/execution.h"
#include "sphere/spherical_points.h"
#include "surface/periodic_surface.h"

#include <vector>

namespace koebe {

/// A map of a surface to the sphere.
struct SphericalMap {
    Vertices points;                ///< (V, 3) unit vectors
    std::vector<Cap> caps;          ///< of the surface's loops
    std::vector<Index> off_circle;  ///< loop vertices that are not on their circle, rising
};

/// Moves the neighbourhoods of flipped faces by foldover-free minimization (foldover_free.h), 2, 4, 8 and 16 rings
/// wide. Each is seen from the middle of the ball, in the plane that touches the sphere there: so the sides of its
/// faces are straight, and its faces upright there are upright on the sphere. Loops are held at first; then they slide
/// along their circles; then the vertices of loops in the neighbourhood are freed.
/// @return how many faces are flipped still, those below sphere_resolution aside
std::size_t turn_back_on_sphere(const PeriodicSurface& domain, SphericalMap& map, const ExecutionContext& context);

}  // namespace koebe
