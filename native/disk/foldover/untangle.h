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

/// Repairs the neighbourhoods of flipped faces (judged as stored, distortion.h) by foldover-free minimization, until no
/// flipped face is left. There are three measures. Patches of 2, then 4, 8 and 16 rings around the faces move with the
/// loops held. Each of these patches then moves with loop vertices that slide along their circles. At last a few
/// vertices are freed from their circles: a face whose vertices span more than half a circle may need this. The first
/// two measures may use three quarters of the effort. A neighbourhood that has failed is not tried again from the same
/// places.
/// @param vertices, surface, loops (the outer loop first), circles the surface and the circles of its image
/// @param off_circle loop vertices that are already off their circles
/// @param uv (V, 2) moved in place
UntangleReport untangle(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                        const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                        const ExecutionContext& context, const UntangleOptions& options = {});

}  // namespace koebe
