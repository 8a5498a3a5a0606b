// Finds parts of a surface that a single interior edge joins to a boundary loop.
#pragma once

#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// An ear or a strip behind an interior edge, the hinge. The hinge joins two vertices of one loop, and no other loop
/// lies behind it. With all loop vertices on their circle the ear would be drawn over its neighbours, as the hinge is
/// a chord of the hole (docs/numerics.md, "Flips").
struct Ear {
    int loop = 0;                 ///< place in the list of loops
    Index first = 0, last = 0;    ///< the hinge: the loop runs from first along the ear to last
    std::vector<Index> rim;       ///< the loop's vertices strictly between first and last, in order
    std::vector<Index> interior;  ///< vertices of no loop
    std::vector<Index> faces;
};

/// The surface without its ears.
struct EarCut {
    std::vector<Ear> ears;
    Surface core;                   ///< on the remaining vertices; empty without ears
    std::vector<Index> vertices;    ///< the surface's vertex for each vertex of the core
    std::vector<VertexLoop> loops;  ///< the shortened loops, in core vertices, in the given order
};

/// Cuts off every ear; nested ears go together. On a disk both sides of every such edge are free of other loops:
/// there the part of the largest area stays. A shortened loop keeps at least three vertices, since no two edges of a
/// mesh join the same vertices.
/// @param loops the surface's loops in any order
EarCut cut_ears(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops);

}  // namespace koebe
