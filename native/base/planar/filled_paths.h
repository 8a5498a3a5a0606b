// Closed curves of the plane, filled by a rule and united.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// Closed polygons that are filled together.
struct FilledPath {
    bool even_odd = false;  ///< rule by the number of windings: odd ones are inside; else all but 0
    std::vector<std::vector<Complex>> rings;
    std::vector<Index> clips;  ///< only what lies in all of these is filled
};

/// A boundary of the filled area, with this area on its left: counter-clockwise outside, clockwise round a hole.
struct FilledBoundary {
    std::vector<Complex> points;
    bool hole = false;
    Index area = -1;  ///< connected areas are numbered; each has one boundary that is no hole
};

/// The union of filled paths. Polygons may cross themselves and each other: crossings are found by a sweep and rounded
/// to floats (divided_segments.h), so that boundaries meet at common points only.
/// @param paths finite
/// @param clips each the union of its paths, which may be clipped in turn, but not by themselves
/// @throws InputError over a million crossings
std::vector<FilledBoundary> united_paths(const std::vector<FilledPath>& paths,
                                         const std::vector<std::vector<FilledPath>>& clips = {});

}  // namespace koebe
