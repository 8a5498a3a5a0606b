// Outlines of a pattern in the UVs.
#pragma once

#include "core/types.h"

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

}  // namespace koebe
