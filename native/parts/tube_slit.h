// Where a tube is opened.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

struct TubeSlit {
    std::vector<int>
        lift;             ///< (3F) whole turns to add to the angle of the strip, per corner; empty: it cannot be opened
    double length = 0.0;  ///< on the surface
};

/// The slit from one loop to the other that is short on the surface and runs straight along the strip (Dijkstra), where
/// a tube is bent on the inside: its sides are two translates of one line, so the opened tube is one to one where the
/// tube is.
/// @param part with two loops and a measured strip
TubeSlit tube_slit(const Part& part);

}  // namespace koebe
