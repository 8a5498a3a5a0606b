// From a triangle soup to a surface of genus 0 with boundary loops, or a typed error.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// A connected, consistently oriented, manifold triangle mesh with boundary.
struct Surface {
    Triangles triangles;            ///< as given, but for faces turned to one orientation
    std::vector<Index> twin;        ///< (3F) opposite half-edge, no_twin on the boundary
    std::vector<VertexLoop> loops;  ///< boundary loops, the surface on the left; by lowest vertex, which comes first
    std::vector<Index> reoriented;  ///< faces whose vertex order was reversed
    std::vector<Index> unused;      ///< vertices of no face
    Index vertex_count = 0;         ///< of the input, unused ones included
    int euler_characteristic = 0;
    int genus = 0;
};

/// @throws InputError a coordinate that is NaN or infinite; elements: vertices
void require_finite(const Vertices& vertices);

/// Checks the arrays themselves.
/// @throws InputError empty arrays, an index out of range, a face that names a vertex twice,
///         a coordinate that is NaN or infinite; elements: faces or vertices, as the message says
KOEBE_API void validate_arrays(const Vertices& vertices, const Triangles& triangles);

/// Pairs half-edges, turns faces to one orientation (that of the majority), finds the boundary loops and the genus.
/// @throws TopologyError nonmanifold_edge, nonmanifold_vertex, nonorientable, disconnected
KOEBE_API Surface analyze_surface(const Triangles& triangles, Index vertex_count);

/// analyze_surface, and then what uniformization needs: genus 0 and at least one loop.
/// @throws TopologyError closed, genus, and all of analyze_surface
KOEBE_API Surface require_bordered_genus_zero(const Triangles& triangles, Index vertex_count);

/// 1 for the vertices on a boundary loop.
std::vector<char> boundary_mask(const Surface& surface);

}  // namespace koebe
