// What counts as flat, straight, along an axis, drawn and similar. Rows as in tuning.h.
#pragma once

#include <numbers>

namespace koebe::tolerance {

/// cosine | of 1 degree: outlines that turn by less go straight on, and noise parts no plane | circles of 360 edges
inline constexpr double straight = 0.99985;
/// radians | between the normals of faces in one plane | half a degree
inline constexpr double coplanar = std::numbers::pi / 360.0;
/// radians | off an axis, or between edges in one direction | a tenth of a degree
inline constexpr double off_axis = std::numbers::pi / 1800.0;
/// of the image's extent | shorter edges are only rounding in 64 bits | chosen
inline constexpr double rounded_edge = 1e-11;
/// of the image's extent | shorter edges say nothing about the course of a loop | 32-bit floats
inline constexpr double drawn_edge = 1e-7;
/// of the outline's length | along the axes: an island is upright, or turned by quarters | chosen
inline constexpr double along_axes = 0.3;
/// of a rolled face's outline | at one ruling, or smooth towards faces that are no plates | chosen
inline constexpr double rolled_outline = 0.3;
/// of an island's area | a smaller island is not similar: all places are looked at again | chosen
inline constexpr double similar_area = 0.8;
/// of a sum | more than half of it | the majority
inline constexpr double majority = 0.5;

}  // namespace koebe::tolerance
