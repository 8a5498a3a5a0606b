// Turns flipped faces of a map to the sphere back.
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
    std::vector<Index> off_circle;  ///< loop vertices off their circle, ascending
};

constexpr std::size_t whole_effort = 300000;  // steps of a face beside those of the whole surface (repair_effort.h)

/// Moves the neighbourhoods of flipped faces by foldover-free minimization (foldover_free.h), 2, 4, 8 and 16 rings
/// wide. Each is projected from the middle of the ball to the plane that touches the sphere there. So the sides of its
/// faces are straight, and faces upright in the plane are upright on the sphere. First loops are held, then they slide
/// along their circles, then the loop vertices in the neighbourhood are freed.
/// @param effort in the unit of whole_effort. With less than that, a repair takes at most twice the effort on any
/// surface
/// @return the number of faces still flipped, except those below sphere_resolution. All stay where so many are flipped
/// that the effort would not do
std::size_t turn_back_on_sphere(const PeriodicSurface& domain, SphericalMap& map, const ExecutionContext& context,
                                std::size_t effort = whole_effort);

}  // namespace koebe
