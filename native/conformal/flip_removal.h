// From the map of the core to one of the whole surface, without flips.
#pragma once

#include "conformal/result.h"
#include "conformal/untangle.h"
#include "core/execution.h"
#include "geometry/flaps.h"

#include <vector>

namespace koebe {

/// A surface on its used vertices, by the names of the input.
struct NamedSurface {
    const Vertices& vertices;  ///< any unit
    const Surface& surface;
    const std::vector<VertexLoop>& loops;  ///< the outer one first
    const std::vector<Index>& original;    ///< vertex of the input for each
};

/// Hangs the flaps back (hang_flaps), turns flipped faces back (untangle), and completes the loop reports: all vertices
/// of each loop, and those that are off its circle.
/// @param core_uv of the core's vertices; of the surface's own if there are no flaps
/// @param reports with the circles of the map
/// @return (V, 2)
PlanarPoints remove_flips(const NamedSurface& whole, const FlapCut& cut, PlanarPoints core_uv,
                          std::vector<LoopReport>& reports, UntangleReport& untangled, ExecutionContext& context);

}  // namespace koebe
