// Finds faces of a mesh in space that meet though they are no neighbours.
#pragma once

#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct MeetingFaces {
    Index pairs = 0;
    bool all = true;           ///< whether all pairs were counted
    std::vector<Index> faces;  ///< of the pairs, ascending
};

/// Pairs of faces without a common vertex that have a common point, by exact predicates (CGAL, box intersection
/// [Zomorodian and Edelsbrunner 2002]). Faces without area are left out. The count ends where there are far more pairs
/// than faces: then the mesh is of no use.
MeetingFaces meeting_faces(const Vertices& vertices, const Triangles& triangles, const ExecutionContext& context);

/// The faces with one number for vertices that lie together, so that tiles side by side are neighbours.
/// @param near largest distance of such vertices
Triangles joined_corners(const Vertices& vertices, const Triangles& triangles, double near);

}  // namespace koebe
