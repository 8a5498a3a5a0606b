// Circle domains with parts that hang on a loop by an edge.
#pragma once

#include "circle_domain.h"

#include <algorithm>

namespace koebe::test {

/// Glues a triangle to the boundary edge a-b of a loop, on its far side.
/// @param height over the edge's length
/// @return the new vertex, put between a and b in the loop
inline Index glue_ear(CircleDomain& domain, int loop, Index a, Index b, double height)
{
    const Index tip = static_cast<Index>(domain.points.size());
    const Complex pa = domain.points[a], pb = domain.points[b];
    domain.points.conservativeResize(tip + 1);
    domain.points[tip] = 0.5 * (pa + pb) - Complex(0.0, height) * (pb - pa);
    domain.triangles.conservativeResize(domain.triangles.rows() + 1, 3);
    domain.triangles.row(domain.triangles.rows() - 1) << b, a, tip;
    VertexLoop& vertices = domain.loops[loop];
    vertices.insert(std::find(vertices.begin(), vertices.end(), a) + 1, tip);
    return tip;
}

}  // namespace koebe::test
