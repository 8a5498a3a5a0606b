// Vertices with given places in the disk.
#pragma once

#include "core/types.h"

namespace koebe {

struct FixedPlaces {
    Index center = -1;  ///< the inner vertex that lies at 0, or -1
    Index point = -1;   ///< the vertex of the outer loop that lies at 1, or -1
};

}  // namespace koebe
