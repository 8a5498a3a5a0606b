// From the map of the core to one of the whole surface, without flips.
#pragma once

#include "conformal/result.h"
#include "core/execution.h"
#include "foldover/untangle.h"
#include "geometry/flaps.h"

#include <vector>

namespace koebe {

/// A surface on its used vertices, by the names of the input.
struct NamedSurface {
    const Vertices& vertices;  ///< any unit
    const Surface& surface;
    const std::vector<VertexLoop>& loops;  ///< the outer one first
    const std::vector<Index>& original;    ///< vertex of the input for each
    const std::vector<Index>& original_faces;
    const std::vector<char>& first_corners;  ///< of each face: the corner that was the first of the input's
};

struct UntangledMap {
    PlanarPoints uv;                ///< (V, 2)
    std::vector<Index> off_circle;  ///< loop vertices that are not on their circles, rising
    UntangleReport report;
};

/// Hangs the flaps back (hang_flaps), flips left as they are.
/// @param core_uv of the core's vertices; of the surface's own if there are no flaps
UntangledMap hang_back(const NamedSurface& whole, const FlapCut& cut, PlanarPoints core_uv, ExecutionContext& context);

/// Hangs the flaps back and turns flipped faces back (untangle).
/// @param core_uv as above @param circles of the loops
UntangledMap remove_flips(const NamedSurface& whole, const FlapCut& cut, PlanarPoints core_uv,
                          const std::vector<Circle>& circles, ExecutionContext& context);

std::vector<Circle> reported_circles(const std::vector<LoopReport>& reports);

/// Puts the map into the result: its points in the input's numbering, its distortion, and what the loop reports, which
/// have their circles, still miss: all vertices of each loop, those that are off its circle, and how round the others
/// lie.
/// @param result of a mesh of result.vertex_count vertices
void report_map(const NamedSurface& whole, const UntangledMap& map, UniformizeResult& result);

}  // namespace koebe
