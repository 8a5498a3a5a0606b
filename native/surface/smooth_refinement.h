// A finer mesh of the surface that a mesh stands for.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

struct RefinedSurface {
    Vertices vertices;    ///< (V + E, 3) the given ones first
    Triangles triangles;  ///< (4F, 3) in one orientation
};

/// Each face cut in four, the new vertices put on the surface that the mesh seems to be cut from: inside on the cubic
/// over the edge that is perpendicular to the normals at its ends (Vlachos et al. 2001, "Curved PN triangles", section
/// 3), at rims on the arc with the mean of the curvatures at the edge's ends. Where a rim turns by more than 60 degrees
/// at one of them it has a corner, and the edge stays straight. What is flat stays flat.
/// @throws TopologyError as analyze_surface
KOEBE_API RefinedSurface refine_smoothly(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
