// Outlines of a pattern in the UVs.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// A closed polygon, counter-clockwise.
struct DrawnOutline {
    std::vector<Complex> points;  ///< in the chart of `face`
    Index face = -1;              ///< of a sheet: holds the first point
    Index group = -1;             ///< outlines of one group are lifted together or not at all
};

}  // namespace koebe
