// Cuts a surface along a loop through each handle: the result has genus 0, loops in pairs, and the holes.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <array>
#include <vector>

namespace koebe {

/// A loop of the cut surface.
struct CutLoop {
    VertexLoop vertices;         ///< in order, the surface on the left
    VectorXd edges;              ///< length of the edge from each vertex to the next
    int handle = -1;             ///< -1 for a hole
    int partner = -1;            ///< the loop on the other side of the handle's cut; its own number for a hole
    std::vector<Index> matches;  ///< place of each vertex on the other side, which runs in reverse
};

/// A surface cut open at its handles. The cut may divide faces of the input.
struct HandleCut {
    Surface surface;                ///< the cut surface
    Vertices vertices;              ///< (V, 3) within the unit cube
    std::vector<Index> original;    ///< (V) vertex of the input; higher numbers are points of the cut inside edges
    std::vector<Index> input_face;  ///< (F) the input's face that holds each face
    std::vector<std::array<Index, 3>> corners;  ///< of each face of the input: half-edges of the surface that start
                                                ///< there, in its orientation
    std::vector<Index> turned;                  ///< faces of the input that were turned to one orientation
    std::vector<CutLoop> loops;  ///< holes by falling length, then the two sides of each handle, longer cuts first
    std::size_t holes = 0;       ///< number of loops that are holes
    int handles = 0;
};

/// Moves and scales vertices (n, 3) into [-1, 1]. @throws InputError all vertices at one point
Vertices in_unit_cube(const Vertices& vertices);

/// Finds the loops of a cut surface, and pairs the two sides of each cut: loops with the same vertices.
/// @param cut complete except for its loops @param handle_of (V) handle and side of each vertex on a cut, which number
/// the loops; empty: number them by length
/// @throws TopologyError as require_bordered_genus_zero
/// @return whether all loops that are not holes have another side, and no two loops share a vertex
bool take_loops(HandleCut& cut, const Triangles& triangles, const std::vector<std::array<int, 2>>& handle_of);

/// Cuts along short loops that share no vertex with each other or with a hole (handle_loops.h).
/// @param vertices, triangles of one orientation, of genus at least 1
/// @param vertex_count of the input: further vertices lie inside its edges, and no error names them
/// @throws TopologyError genus: loops along edges cannot avoid each other
HandleCut cut_handles(const Vertices& vertices, const Triangles& triangles, Index vertex_count,
                      ExecutionContext& context);

}  // namespace koebe
