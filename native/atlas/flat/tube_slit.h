// The slit along which a tube is opened.
#pragma once

#include "splitting/splitting.h"

#include <vector>

namespace koebe {

struct TubeSlit {
    std::vector<int> lift;  ///< (3F) whole turns added to the strip's angle at each corner; empty: no slit was found
    double length = 0.0;    ///< on the surface
};

/// A slit from one loop to the other, short on the surface and straight along the strip (Dijkstra). On a bent tube it
/// runs along the inside of the bend. Its two sides are translates of one line, so the opened tube is one to one if the
/// tube is.
/// @param part a part with two loops and a measured strip
TubeSlit tube_slit(const Part& part);

}  // namespace koebe
