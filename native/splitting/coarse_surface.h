// A surface with fewer faces.
#pragma once

#include "evenness/part_mesh.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct CoarseSurface {
    Vertices vertices;
    Triangles triangles;
    std::vector<Index> face;       ///< of the fine surface, which each face was
    std::vector<Index> vertex_at;  ///< (V) the vertex of the coarse surface to which each of the fine one was drawn
};

/// The edges collapsed by which vertices are drawn least far, until so many faces are left or none can go: no face
/// turned over, the topology and the number of loops kept (OpenMesh's collapse).
CoarseSurface coarse_surface(const CutSurface& whole, Index faces, ExecutionContext& context);

}  // namespace koebe
