// Finds parts of a surface that hang on one boundary loop by a single interior edge.
#pragma once

#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// An ear or a strip behind an interior edge, the hinge. The hinge joins two vertices of one loop, and no other loop
/// lies behind it. With all loop vertices on their circle the flap would be drawn over its neighbours, as the hinge is
/// a chord of the hole (docs/numerics.md, "Flips").
struct Flap {
    int loop = 0;                 ///< place in the list of loops
    Index first = 0, last = 0;    ///< the hinge: the loop runs from first along the flap to last
    std::vector<Index> rim;       ///< the loop's vertices strictly between first and last, in order
    std::vector<Index> interior;  ///< vertices of no loop
    std::vector<Index> faces;
};

/// The surface without its flaps.
struct FlapCut {
    std::vector<Flap> flaps;
    Surface core;                   ///< on the remaining vertices; empty without flaps
    std::vector<Index> vertices;    ///< the surface's vertex for each vertex of the core
    std::vector<VertexLoop> loops;  ///< the shortened loops, in core vertices, in the given order
};

/// Cuts off every flap; nested flaps go together. On a disk both sides of every such edge are free of other loops:
/// there the part of the largest area stays. A shortened loop keeps at least three vertices, since no two edges of a
/// mesh join the same vertices.
/// @param loops the surface's loops in any order
FlapCut cut_flaps(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops);

}  // namespace koebe
