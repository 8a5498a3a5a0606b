// Triangle connectivity in flat arrays: half-edge h = 3 f + k runs from corner k of face f to the next.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

constexpr Index no_twin = -1;

inline Index face_of(Index halfedge) { return halfedge / 3; }
inline Index next_halfedge(Index halfedge) { return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1; }
inline Index previous_halfedge(Index halfedge) { return halfedge % 3 == 0 ? halfedge + 2 : halfedge - 1; }

inline Index origin(const Triangles& triangles, Index halfedge) { return triangles.data()[halfedge]; }
inline Index target(const Triangles& triangles, Index halfedge) { return triangles.data()[next_halfedge(halfedge)]; }

/// Pairs the half-edges of each edge. Faces may have any orientation.
/// @return (3F) the other half-edge on the same edge, or no_twin on the boundary
/// @throws TopologyError nonmanifold_edge where an edge has three or more faces
std::vector<Index> pair_halfedges(const Triangles& triangles, Index vertex_count);

/// (V) 1 for each vertex of no face.
std::vector<char> unused_vertices(const Triangles& triangles, Index vertex_count);

}  // namespace koebe
