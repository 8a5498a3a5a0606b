// Coordinates in pictures of UVs: whole numbers, which every viewer reads alike.
#pragma once

#include <cmath>
#include <string>

namespace koebe {

inline constexpr double picture_size = 10000.0;  // picture units of the unit square

inline std::string pixels(double t) { return std::to_string(std::lround(picture_size * t)); }

}  // namespace koebe
