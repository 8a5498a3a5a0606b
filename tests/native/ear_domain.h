// Circle domains with parts that hang on a loop by an edge.
#pragma once

#include "circle_domain.h"
#include "pipeline/uniformize.h"

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

/// Five triangles in a row without inner vertices: 0 2 4 6 below, 1 3 5 above; the triangle 2 3 4 is the widest.
inline CircleDomain strip_of_triangles()
{
    CircleDomain strip;
    strip.points.resize(7);
    strip.points << Complex(0, 0), Complex(0.5, 1), Complex(1, 0), Complex(3, 1), Complex(5, 0), Complex(5.5, 1),
        Complex(6, 0);
    strip.triangles.resize(5, 3);
    strip.triangles << 0, 2, 1, 2, 3, 1, 2, 4, 3, 4, 5, 3, 4, 6, 5;
    strip.loops = {{0, 2, 4, 6, 5, 3, 1}};
    return strip;
}

/// The map of the flat domain, its first loop the outer one.
inline UniformizeResult map_flat(const CircleDomain& domain)
{
    ExecutionContext context;
    UniformizeOptions options;
    options.outer = OuterLoop::vertex;
    options.outer_vertex = domain.loops[0].front();
    return uniformize(lift(domain.points, Lift::plane), domain.triangles, options, context);
}

}  // namespace koebe::test
