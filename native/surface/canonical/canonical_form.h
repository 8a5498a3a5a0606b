// Numbers and coordinates of a surface that follow from its shape alone.
#pragma once

#include "core/types.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// The order of vertices and faces, and the position in space.
struct CanonicalForm {
    Surface surface;                       ///< on its used vertices
    Vertices vertices;                     ///< (V, 3) within the unit ball, rounded to a grid
    std::vector<Index> original_vertices;  ///< of the input, for each vertex
    std::vector<Index> original_faces;     ///< of the input, for each face
    double thinnest = 0.0;                 ///< least height of a face in grid steps
};

/// A surface gets the same form, nearly always to the last bit, if it is renumbered, turned, moved or scaled. So
/// results computed from it do not depend on the input's numbers and frame, even where they depend on the last bits.
///
/// Vertices and faces are numbered breadth first from the longest boundary edge. Among edges of equal length a hash of
/// edge lengths around them decides (Weisfeiler and Lehman 1968). The origin is the mean of the vertices. The first
/// axis points to the vertex farthest from the origin, the second axis towards the vertex farthest from the first axis.
/// Coordinates are rounded to 2^-34 of the extent, or finer where edges are short. A turn of the surface changes the
/// last digits, and the grid removes this change. It stays only in coordinates within some 1e-16 of the middle between
/// two grid points.
/// @param surface with at least one loop @param vertices (V, 3) finite
/// @throws InputError all vertices lie on one point
CanonicalForm canonical_form(const Surface& surface, const Vertices& vertices);

}  // namespace koebe
