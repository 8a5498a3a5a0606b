// The lengths below which a map in 32-bit UVs tells nothing.
#pragma once

namespace koebe {

/// UV units: a face whose longest edge is shorter is below the resolution of 32-bit UVs, which have steps of 6e-8
/// there.
inline constexpr double uv_resolution = 1e-6;

/// Disk units: how far from its circle a loop vertex may lie to count as on it. The disk is 2 wide, the UV square 1.
inline constexpr double circle_tolerance = 1e-6;

/// Disk units: how far a vertex is moved off its circle, or found there, and still counts as on it with room for
/// rounding.
inline constexpr double inner_circle_tolerance = 0.5 * circle_tolerance;

}  // namespace koebe
