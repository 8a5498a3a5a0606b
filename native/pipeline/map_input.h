// The input made ready: used vertices alone, a unit scale, the loops in the order of the iteration.
#pragma once

#include "core/types.h"
#include "flaps/flaps.h"
#include "mesh/topology.h"
#include "pipeline/options.h"

#include <vector>

namespace koebe {

inline constexpr double same_length = 1e-9;  ///< relative difference of loops that are equally long

/// The surface in its canonical form, with the loops in the order of the iteration.
struct MapInput {
    Surface surface;
    Vertices vertices;
    std::vector<Index> original;        // vertex of the input for each vertex
    std::vector<Index> original_faces;  // face of the input for each face; of a core: empty
    std::vector<VertexLoop> loops;      // outer first, then by falling length on the surface
    std::vector<VectorXd> edges;        // length of the edge from each loop vertex to the next
    VectorXd importance;                // of the vertices, the least one 0; empty: all alike
    double thinnest = 0.0;              // least height of a face, in steps of the canonical grid
    Index center = -1, point = -1;      // vertices that go to 0 and to 1, if any; of a core: none
    int outer_rank = 0;                 // of the outer loop among the input's, which go by their lowest vertices
};

/// Whether the surface is a disk without inner vertices.
bool is_polygon(const MapInput& input);

/// The place of a loop of the surface among the input's loops, which are in the order of their lowest vertices.
int rank_by_lowest_vertex(const MapInput& input, const VertexLoop& loop);

/// @throws InputError importance without a balance, of another number of vertices, or not from 0 to 1
void require_importance(const UniformizeOptions& options, Index vertex_count);

/// @throws InputError, TopologyError
MapInput prepare_input(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options);

/// The same surface with its vertices elsewhere: its loops keep their order, the outer one too.
/// @param vertices (V, 3) of the input, as many as before @throws InputError
void move_input(MapInput& input, const Vertices& vertices);

/// The surface without its flaps; takes the surface out of the cut.
MapInput core_input(const MapInput& whole, FlapCut& cut);

}  // namespace koebe
