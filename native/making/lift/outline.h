// Outlines of a pattern in the UVs.
#pragma once

#include "core/errors.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

/// A closed polygon, counter-clockwise.
struct DrawnOutline {
    std::vector<Complex>
        points;         ///< in the chart of `face`, of the sheet or the sphere's chart with the number `chart`
    Index face = -1;    ///< of a sheet: holds the first point
    int chart = -1;     ///< of a sphere (sphere_sheets.h); -1: the sheet itself
    Index group = -1;   ///< outlines of one group are lifted together or not at all
    bool hole = false;  ///< in an outline of its group: the faces inside it are the ground again
};

/// Bounds the work of a pattern before it is done.
/// @param points of all outlines, counted as often as they are drawn @param size the words for the size that is too
/// small @param face where outlines lie; -1: they lie everywhere
/// @throws InputError there are too many
inline void require_few_outlines(double outlines, double points, const char* size, Index face = -1)
{
    constexpr double most_points = 4e6;  // at 3 to 10 µs a point
    if (points <= most_points) return;
    const std::string count = outlines < 1e15 ? std::to_string(static_cast<long long>(outlines)) : "over 1e15";
    throw InputError(size + (" is too small for the surface: " + count + " outlines are too many to draw"),
                     ElementKind::faces, face >= 0 ? std::vector{face} : std::vector<Index>());
}

}  // namespace koebe
