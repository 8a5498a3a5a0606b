// Vertices whose places in the disk are given.
#pragma once

#include "core/types.h"

namespace koebe {

struct FixedPlaces {
    Index center = -1;  ///< the vertex, of no loop, that lies at 0; -1: none
    Index point = -1;   ///< the one of the outer loop that lies at 1; -1: none
};

}  // namespace koebe
