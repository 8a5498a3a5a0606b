// Makes a connected manifold surface of a triangle soup, or throws a typed error.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// A connected, consistently oriented, manifold triangle mesh with boundary.
struct Surface {
    Triangles triangles;            ///< the input's, with some faces turned to one orientation
    std::vector<Index> twin;        ///< (3F) opposite half-edge, no_twin on the boundary
    std::vector<VertexLoop> loops;  ///< the boundary, surface on the left; each from its lowest vertex, sorted by it
    std::vector<Index> reoriented;  ///< faces whose vertex order was reversed
    std::vector<Index> unused;      ///< vertices of no face
    Index vertex_count = 0;         ///< of the input, with unused vertices
    int euler_characteristic = 0;
    int genus = 0;
};

/// @throws InputError a coordinate that is NaN or infinite; elements: vertices
void require_finite(const Vertices& vertices);

/// Checks the arrays themselves.
/// @throws InputError empty arrays, an index out of range, a face that names a vertex twice, a coordinate that is NaN
/// or infinite; elements: faces or vertices, as the message says
KOEBE_API void validate_arrays(const Vertices& vertices, const Triangles& triangles);

/// Pairs half-edges, turns faces to the orientation of the majority, finds the boundary loops and the genus.
/// @throws TopologyError nonmanifold_edge, nonmanifold_vertex, nonorientable, disconnected
KOEBE_API Surface analyze_surface(const Triangles& triangles, Index vertex_count);

/// Calls analyze_surface and requires genus 0 and at least one loop, as uniformization does.
/// @throws TopologyError closed, genus, and the errors of analyze_surface
KOEBE_API Surface require_bordered_genus_zero(const Triangles& triangles, Index vertex_count);

/// (V) 1 for each vertex on a boundary loop.
std::vector<char> boundary_mask(const Surface& surface);

}  // namespace koebe
