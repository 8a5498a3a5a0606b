// A one-to-one map of any surface of genus 0 with boundary: convex combinations (Tutte 1963, Floater 2003).
#pragma once

#include "core/topology.h"

#include <vector>

namespace koebe {

/// The surface with a fan of triangles in every inner hole, round a vertex of its own: a disk.
struct FilledSurface {
    Triangles triangles;     ///< the surface's faces first
    Index surface_vertices;  ///< the fans' centres follow these, one for each inner loop
    Index vertex_count;
};

/// @param loops the outer one, which stays open, first
FilledSurface fill_with_fans(const Surface& surface, const std::vector<VertexLoop>& loops);

/// The outer loop on the unit circle, every other vertex a weighted mean of its neighbours with positive weights. In exact
/// arithmetic every triangle keeps its orientation, whatever the weights (Floater 2003, theorem 6: the boundary is
/// strictly convex). The weights are there for arithmetic that is not exact: equal ones draw what lies deep inside
/// exponentially small, so edges that came out short are made softer, in some rounds (as Yoshizawa, Belyaev and Seidel
/// 2004 lower the stretch).
/// @param rim (n) points of the outer loop on the unit circle, in order, all different
/// @return (filled.vertex_count, 2) the round in which most triangles are upright and large enough for 32-bit UVs
PlanarPoints convex_embedding(const FilledSurface& filled, const VertexLoop& outer, const VectorXcd& rim);

}  // namespace koebe
