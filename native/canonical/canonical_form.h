// A surface in numbers and coordinates that follow from its shape alone.
#pragma once

#include "core/types.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Order of vertices and faces, and a position in space.
struct CanonicalForm {
    Surface surface;                       ///< on its used vertices
    Vertices vertices;                     ///< (V, 3) within the unit ball, on a grid
    std::vector<Index> original_vertices;  ///< of the input, for each vertex
    std::vector<Index> original_faces;     ///< of the input, for each face
    double thinnest = 0.0;                 ///< least height of a face, in steps of the grid
};

/// The same surface, renumbered, turned, moved or scaled, gets the same form, as a rule to the last bit. So whatever is
/// computed from it does not depend on the input's numbering and frame, even where it hangs on the last bits.
///
/// Vertices and faces are numbered breadth first from one boundary edge: the longest; among edges as long, the one
/// whose neighbourhood comes first by a hash of edge lengths (Weisfeiler and Lehman 1968). The origin is the mean of
/// the vertices, the first axis points to the vertex farthest from it, the second towards the one farthest from the
/// first axis. Coordinates are rounded to 2^-34 of the extent, less where edges are short: turning a surface changes
/// the last digits of its coordinates, and the grid takes these away. Only a coordinate within some 1e-16 of the middle
/// between two points of the grid still shows them.
/// @param surface with at least one loop @param vertices (V, 3) finite
/// @throws InputError all vertices lie on one point
CanonicalForm canonical_form(const Surface& surface, const Vertices& vertices);

}  // namespace koebe
