// Splits long edges of a polyhedron.
#pragma once

#include "core/types.h"

#include <functional>

namespace koebe {

/// Vertices, the surface's first, and faces.
struct Polyhedron {
    Vertices vertices;
    Triangles triangles;
};

/// Splits edges in two, and their faces in two to four; faces stay flat.
/// @param too_long takes an edge's ends @return whether an edge was split
bool split_edges(Polyhedron& mesh, const std::function<bool(Index, Index)>& too_long);

}  // namespace koebe
