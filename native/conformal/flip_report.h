// What to tell the user about flaps, freed vertices, flips and limbs that shrank too far.
#pragma once

#include "conformal/result.h"
#include "conformal/untangle.h"
#include "geometry/flaps.h"

#include <string>
#include <vector>

namespace koebe {

/// The surface as mapped, on its used vertices.
struct MappedSurface {
    const Vertices& vertices;                ///< any unit
    const Surface& surface;
    const std::vector<VertexLoop>& loops;    ///< the outer one first
    const std::vector<Index>& original;      ///< vertex of the input for each
    const PlanarPoints& uv;
};

/// One sentence for each thing that is out of the ordinary, with its number, the input's first element and, for what
/// shrank below the resolution of 32-bit UVs, each region's place: its tip, the nearest loop and its size.
std::vector<std::string> flip_warnings(const MappedSurface& map, const std::vector<Flap>& flaps,
                                       const UntangleReport& untangled, const Distortion& distortion);

}  // namespace koebe
