// A surface with handles, cut along a loop through each: genus 0, its loops in pairs, and the holes.
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
    int partner = -1;            ///< the other side of the handle's cut, another loop; its own number for a hole
    std::vector<Index> matches;  ///< for each vertex its place on the other side, which runs the other way round
};

/// Faces of the input may be divided where the cut runs through them.
struct HandleCut {
    Surface surface;              ///< the cut one
    Vertices vertices;            ///< (V, 3) within the unit cube
    std::vector<Index> original;  ///< (V) vertex of the input; from its vertex count on points of the cut inside edges
    std::vector<Index> input_face;              ///< (F) face of the input that each face is or lies in
    std::vector<std::array<Index, 3>> corners;  ///< of each face of the input: half-edges of the surface that start
                                                ///< there, in its orientation
    std::vector<Index> turned;                  ///< faces of the input that were turned to one orientation
    std::vector<CutLoop> loops;  ///< holes by falling length, then the two sides of each handle, longer cuts first
    std::size_t holes = 0;       ///< so many of the loops
    int handles = 0;
};

/// Vertices (n, 3) moved and scaled into [-1, 1]. @throws InputError all on one point
Vertices in_unit_cube(const Vertices& vertices);

/// Finds the loops of a cut surface, and which of them are the two sides of a cut: those of the same vertices.
/// @param cut all but its loops @param handle_of (V) handle and side of each vertex on a cut, to be numbered so; empty:
/// by length
/// @throws TopologyError those of require_bordered_genus_zero
/// @return whether all loops that are no holes found their other sides, and no two share a vertex
bool take_loops(HandleCut& cut, const Triangles& triangles, const std::vector<std::array<int, 2>>& handle_of);

/// Cut along short loops that share no vertex with each other or with a hole (handle_loops.h).
/// @param vertices, triangles of one orientation, of genus 1 at least
/// @param vertex_count of the input: vertices beyond are inside its edges, and no error names them
/// @throws TopologyError genus: loops that cannot keep apart along the edges
HandleCut cut_handles(const Vertices& vertices, const Triangles& triangles, Index vertex_count,
                      ExecutionContext& context);

}  // namespace koebe
