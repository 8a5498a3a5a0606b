// A surface to be mapped to a torus, a cylinder or a sphere. Each vertex has one position per sum of periods.
#pragma once

#include "mesh/topology.h"
#include "surface/intrinsic_metric.h"
#include "surface/one_form.h"

#include <array>
#include <vector>

namespace koebe {

/// The used vertices of a mesh in a frame of its own, and closed integer forms that count periods. Along a
/// half-edge the position changes by target - origin + sum_j shifts[j] * period j.
struct PeriodicSurface {
    Surface surface;
    Vertices vertices;                   ///< (V, 3), coordinates within [-1, 1]
    std::vector<Index> original;         ///< the input's vertex for each vertex
    std::vector<VertexLoop> loops;       ///< by falling length on the surface; the two rims of a ring come first
    std::vector<VectorXd> edges;         ///< length of the edge from each loop vertex to the next
    std::size_t first_hole = 0;          ///< 2 for a ring: loops from this number on are holes
    std::vector<OneForm> shifts;         ///< two for a torus, one for a ring, no form for a sphere; 0 along holes
    IntrinsicMetric metric;              ///< of the surface
    std::vector<OneForm> metric_shifts;  ///< the same forms on the metric's half-edges
    std::vector<Index> polygon;          ///< (F) a tile keeps faces of one number together; empty: each face by itself

    /// The shifts of a half-edge of the surface.
    std::array<int, 2> shift(Index halfedge) const;
    /// The input's vertices on a loop, in order from the lowest.
    VertexLoop named_loop(std::size_t k) const;
    /// The input's vertices on a loop, ascending, that are among these of the surface. @param vertices ascending
    std::vector<Index> named_on_loop(std::size_t k, const std::vector<Index>& vertices) const;
};

/// Makes a periodic surface of genus 1 with any number of holes. The forms are dual to two loops that generate the
/// homology of the torus with its holes filled, by a tree of edges and a tree of faces (Eppstein 2003). Wedge: 1.
/// @throws InputError, TopologyError genus and the errors of analyze_surface
PeriodicSurface periodic_torus(const Vertices& vertices, const Triangles& triangles);

/// Makes a surface of genus 0 with any number of holes. It has no periods and no metric.
/// @throws InputError, TopologyError genus and the errors of analyze_surface
PeriodicSurface periodless_sphere(const Vertices& vertices, const Triangles& triangles);

/// Makes a ring: genus 0, at least two loops, two of them its rims. The form has period 1 round the outer rim.
/// @param outer, inner a vertex of each rim; -1: the longest loops
/// @throws InputError a vertex on no loop, or both on the same loop; TopologyError closed (fewer than two loops), genus
/// and the errors of analyze_surface
PeriodicSurface periodic_ring(const Vertices& vertices, const Triangles& triangles, Index outer, Index inner);

}  // namespace koebe
