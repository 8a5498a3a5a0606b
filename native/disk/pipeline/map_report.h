// Reports a map: its points in the input's numbering, its loops, its distortion.
#pragma once

#include "circles/circle_map.h"
#include "pipeline/map_input.h"
#include "pipeline/result.h"

namespace koebe {

/// The map in the numbers of the input. @param vertex_count of the input
ConformalDomain domain_of(const MapInput& whole, const CircleMap& map, Index vertex_count);

/// Keeps the domain that shapes are compared by beside the map of the result, whose circles are not the surface's own.
void keep_conformal(ConformalDomain domain, UniformizeResult& result);

/// Fills uv, loops and distortion of the result. A loop vertex is off its circle if the map says so, or if it lies
/// farther from the circle than circle_tolerance.
/// @param vertices, triangles of the input, as a reader of the result has them @param map of the surface
/// @param result of a mesh of result.vertex_count vertices
void report_map(const Vertices& vertices, const Triangles& triangles, const MapInput& whole, const CircleMap& map,
                UniformizeResult& result);

}  // namespace koebe
