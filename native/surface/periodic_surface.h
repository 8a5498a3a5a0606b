// A surface that a map takes to a torus, a cylinder or a sphere: a vertex has one position for each sum of periods.
#pragma once

#include "mesh/topology.h"
#include "surface/intrinsic_metric.h"
#include "surface/one_form.h"

#include <array>
#include <vector>

namespace koebe {

/// The used vertices of a mesh, in a frame of its own, and the closed integer forms whose multiples of the periods are
/// added along half-edges: from the position of the origin to that of the target it is target - origin + sum_j
/// shifts[j] * period j.
struct PeriodicSurface {
    Surface surface;
    Vertices vertices;                   ///< (V, 3) within the unit cube
    std::vector<Index> original;         ///< vertex of the input for each vertex
    std::vector<VertexLoop> loops;       ///< by falling length on the surface; of a ring its two rims first
    std::vector<VectorXd> edges;         ///< length of the edge from each loop vertex to the next
    std::size_t first_hole = 0;          ///< 2 for a ring: the loops from there on are holes
    std::vector<OneForm> shifts;         ///< two for a torus, one for a ring, none for a sphere; 0 along holes
    IntrinsicMetric metric;              ///< of the surface
    std::vector<OneForm> metric_shifts;  ///< the same forms on its half-edges
    std::vector<Index> polygon;          ///< (F) faces of one number stay together in a tile; empty: each by itself

    std::size_t period_count() const { return shifts.size(); }
    /// The integers of a half-edge of the surface.
    std::array<int, 2> shift(Index halfedge) const;
};

/// Of genus 1, with any number of holes: forms dual to two loops that generate the homology of the torus, with the
/// holes filled, by a tree of edges and a tree of the faces across the others (Eppstein 2003). Their wedge is 1.
/// @throws InputError, TopologyError genus and those of analyze_surface
PeriodicSurface periodic_torus(const Vertices& vertices, const Triangles& triangles);

/// Of genus 0, with any number of holes or none: no periods, and no metric.
/// @throws InputError, TopologyError genus and those of analyze_surface
PeriodicSurface periodless_sphere(const Vertices& vertices, const Triangles& triangles);

/// Of genus 0 with two loops at least, two of them the rims: the form is 1 round the outer one.
/// @param outer, inner vertices of them; -1: the longest loops
/// @throws InputError a vertex on no loop, or both on one; TopologyError closed (fewer than two loops), genus and those
/// of analyze_surface
PeriodicSurface periodic_ring(const Vertices& vertices, const Triangles& triangles, Index outer, Index inner);

}  // namespace koebe
