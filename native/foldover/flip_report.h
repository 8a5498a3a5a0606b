// What to tell the user about flaps, freed vertices, flips and limbs that shrank too far.
#pragma once

#include "conformal/result.h"
#include "foldover/flip_removal.h"

#include <string>
#include <vector>

namespace koebe {

/// One sentence for each thing that is out of the ordinary, with its number, the input's first element and, for what
/// shrank below the resolution of 32-bit UVs, each region's place: its tip, the nearest loop and its size.
std::vector<Warning> flip_warnings(const NamedSurface& whole, const PlanarPoints& uv, const std::vector<Flap>& flaps,
                                   const UntangleReport& untangled, const Distortion& distortion);

}  // namespace koebe
