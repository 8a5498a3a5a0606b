// Turns flipped faces back, by moving as little as possible.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "foldover/repair_effort.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

struct UntangleOptions {
    bool slide = true;               ///< along the circles, before any vertex is freed
    std::vector<Index> held = {};    ///< vertices that stay where they are
    RepairEffort* effort = nullptr;  ///< of several searches on the same surface
    double share = 1.0;              ///< of what is left of it
};

struct UntangleReport {
    int repairs = 0;             ///< neighbourhoods that were moved
    std::vector<Index> freed;    ///< loop vertices that had to leave their circles
    std::vector<Index> tangled;  ///< faces still flipped, those below resolution aside
};

/// Repairs the neighbourhoods of flipped faces (judged as stored, distortion.h) by foldover-free minimization, from
/// the mildest measure to the harshest, until none is left: 2, 4, 8 and 16 rings around them with the loops held; the
/// same with the loops' vertices sliding along their circles; the same with a few vertices freed from their circles,
/// which a face between vertices that span more than half a circle may need. The first two
/// get three quarters of the effort at most, and a problem that has failed is not posed again.
/// @param vertices, surface, loops (the outer one first), circles the surface and its image's circles
/// @param off_circle loop vertices that are off their circles already
/// @param uv (V, 2) moved in place
UntangleReport untangle(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                        const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                        const ExecutionContext& context, const UntangleOptions& options = {});

}  // namespace koebe
