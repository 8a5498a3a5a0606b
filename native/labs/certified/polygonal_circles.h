// The circles of the polyhedron itself: its rims are polygons, not samples of smooth curves.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <cstddef>
#include <vector>

namespace koebe {

/// What a mesh says of the rims of the surface, for numbers of its shape. The two differ by the areas between the edges
/// of a rim and its arcs (docs/numerics.md, the circles of the polyhedron itself).
enum class RimKind {
    smooth,        ///< samples of smooth curves: the circles of the map
    polygonal,     ///< polygons: the circles of the polyhedron, which the enclosures of capacities.h prove
    extrapolated,  ///< samples of smooth curves: the limit of finer and finer meshes (extrapolated_circles)
};

KOEBE_API const char* to_string(RimKind rims) noexcept;

inline constexpr std::size_t most_polygonal_loops = 12;  // the time grows with the fourth power of their number

struct PolygonalCircles {
    std::vector<Circle> circles;  ///< in the order of the given loops, in the module's position (conformal_module.h)
    /// The same, of upper bounds of all capacities. The change shows the error of `circles` (module_error).
    std::vector<Circle> of_upper_bounds;
};

/// The circle domain of the polyhedral surface. Its capacities are enclosed (certified/capacities.h) to 3e-4 of the
/// largest one. Gauss's and Newton's method finds the circles whose capacities are the middles of these enclosures. It
/// begins at the circles of the map.
/// @param loops of the map, whose circles are the surface's own: at most most_polygonal_loops
/// @param threads at most; 0: all cores
/// @throws InputError more loops; circles that are not the surface's own, or that meet; faces without area (listed);
/// SolverError circles that do not settle; Cancelled
KOEBE_API PolygonalCircles polygonal_circles(const Vertices& vertices, const Triangles& triangles,
                                             const std::vector<LoopReport>& loops, int threads,
                                             ExecutionContext& context);

/// The limit of the circles on finer and finer meshes of a smooth surface with smooth rims. On such meshes errors fall
/// as h^2, so Richardson's extrapolation takes (4 refined - given) / 3 of each number of the module.
/// @param refined on a mesh with four times as many faces (shape/module_error.h)
/// @return in the module's position @throws SolverError circles that meet then
KOEBE_API std::vector<Circle> extrapolated_circles(const std::vector<Circle>& given,
                                                   const std::vector<Circle>& refined);

/// Forecast of what polygons in place of smooth curves do to the circles: the change of each loop's radius relative to
/// the radius, to first order and without the effect of other loops. An edge of length h in the disk between corners
/// that turn by t on the surface lies t h / 12 inside its arc on average, and each circle moves inwards by the mean.
/// @param uv (V, 2) of the unit disk @return (L); the rim of the disk becomes the unit circle again
KOEBE_API VectorXd polygonal_changes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                                     const std::vector<LoopReport>& loops);

}  // namespace koebe
