// Draws a map to the sphere.
#pragma once

#include "core/types.h"
#include "sphere/sphere_map.h"

#include <string>

namespace koebe {

/// Draws the sphere from the front, along y, and from behind, side by side: its edges, and its holes as caps.
/// @param triangles of the input
std::string sphere_svg(const Triangles& triangles, const SphereResult& result);

}  // namespace koebe
