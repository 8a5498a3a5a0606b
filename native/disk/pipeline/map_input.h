// Prepares the input: used vertices only, a unit scale, the loops in the order of the iteration.
#pragma once

#include "core/types.h"
#include "ears/ears.h"
#include "mesh/topology.h"
#include "pipeline/options.h"

#include <vector>

namespace koebe {

inline constexpr double same_length = 1e-9;  ///< relative difference of loops that are equally long

/// The surface in its canonical form, with the loops in the order of the iteration.
struct MapInput {
    Surface surface;
    Vertices vertices;
    std::vector<Index> original;        // the input's vertex for each vertex
    std::vector<Index> original_faces;  // the input's face for each face; empty in a core
    std::vector<VertexLoop> loops;      // the outer loop, then by falling length on the surface
    std::vector<VectorXd> edges;        // length of the edge from each loop vertex to the next
    VectorXd importance;                // of each vertex, the least one 0; empty: all alike
    double thinnest = 0.0;              // least height of a face, in steps of the canonical grid
    Index center = -1, point = -1;      // vertices that go to 0 and to 1, or -1; -1 in a core
    int outer_rank = 0;                 // of the outer loop among the input's loops, sorted by lowest vertex
};

/// Whether the surface is a disk without inner vertices.
bool is_polygon(const MapInput& input);

/// The place of a loop among the input's loops, sorted by their lowest vertices.
int rank_by_lowest_vertex(const MapInput& input, const VertexLoop& loop);

/// @throws InputError importance without a balance or an even map, for another number of vertices, or not from 0 to 1
void require_importance(const UniformizeOptions& options, Index vertex_count);

/// @throws InputError, TopologyError
MapInput prepare_input(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options);

/// Moves the vertices of a surface. All loops keep their order, the outer loop too.
/// @param vertices (V, 3) of the input, as many as before @throws InputError
void move_input(MapInput& input, const Vertices& vertices);

/// The surface without its ears. Moves the surface out of the cut.
MapInput core_input(const MapInput& whole, EarCut& cut);

}  // namespace koebe
