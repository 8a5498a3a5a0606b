// Turns flipped faces back with as little motion as possible.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "foldover/repair_effort.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

struct UntangleOptions {
    bool slide = true;               ///< try to slide along the circles before freeing any vertex
    std::vector<Index> held = {};    ///< vertices that stay where they are
    RepairEffort* effort = nullptr;  ///< shared by several searches on the same surface
    double share = 1.0;              ///< share of the effort left that may be used
};

struct UntangleReport {
    int repairs = 0;             ///< neighbourhoods that were moved
    std::vector<Index> freed;    ///< loop vertices that had to leave their circles
    std::vector<Index> tangled;  ///< faces still flipped, except those below resolution
};

/// Repairs the neighbourhoods of flipped faces (judged as stored, distortion.h) by foldover-free minimization, from the
/// mildest measure to the harshest, until no flipped face is left. First 2, 4, 8 and 16 rings around them with the
/// loops held; then the same with loop vertices sliding along their circles; then with a few vertices freed from their
/// circles, which a face may need whose vertices span more than half a circle. The first two measures may use three
/// quarters of the effort. A problem that has failed is not tried again.
/// @param vertices, surface, loops (the outer one first), circles the surface and its image's circles
/// @param off_circle loop vertices that are already off their circles
/// @param uv (V, 2) moved in place
UntangleReport untangle(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                        const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                        const ExecutionContext& context, const UntangleOptions& options = {});

}  // namespace koebe
