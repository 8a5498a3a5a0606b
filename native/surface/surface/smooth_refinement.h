// Refines a mesh towards the smooth surface that it approximates.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

struct RefinedSurface {
    Vertices vertices;    ///< (V + E, 3) the input's vertices first
    Triangles triangles;  ///< (4F, 3) in one orientation
};

/// Cuts each face in four and puts the new vertices on the smooth surface. Inside, a new vertex lies on the cubic over
/// its edge that is perpendicular to the normals at the ends (Vlachos et al. 2001, "Curved PN triangles", section 3).
/// At a rim it lies on the arc with the mean of the curvatures at the edge's ends. Where a rim turns by more than 60
/// degrees it has a corner, and the edges at it stay straight. Flat regions stay flat.
/// @throws TopologyError as analyze_surface
KOEBE_API RefinedSurface refine_smoothly(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
