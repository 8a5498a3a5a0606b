// The lengths that 32-bit UVs cannot resolve.
#pragma once

namespace koebe {

/// UV units. A face whose longest edge is shorter is below the resolution of 32-bit UVs (steps of 6e-8).
inline constexpr double uv_resolution = 1e-6;

/// Radii: how far from its circle a loop vertex may lie.
inline constexpr double circle_tolerance = 1e-6;

/// Radii: how far a vertex may be moved off its circle, or be found off it. It leaves room for rounding.
inline constexpr double inner_circle_tolerance = 0.5 * circle_tolerance;

}  // namespace koebe
