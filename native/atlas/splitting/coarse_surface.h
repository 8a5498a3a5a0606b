// A surface with fewer faces.
#pragma once

#include "execution/execution.h"
#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

struct CoarseSurface {
    Vertices vertices;
    Triangles triangles;
    std::vector<Index> face;       ///< for each coarse face the fine face from which it came
    std::vector<Index> vertex_at;  ///< (V) for each fine vertex the coarse vertex that it was moved to
};

/// Collapses edges (OpenMesh), those first that move vertices least, until `faces` are left or no edge can go. Never
/// turns a face over. Keeps the topology and the number of loops.
CoarseSurface coarse_surface(const CutSurface& whole, Index faces, ExecutionContext& context);

}  // namespace koebe
