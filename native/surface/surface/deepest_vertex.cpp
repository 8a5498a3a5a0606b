#include "surface/deepest_vertex.h"

namespace koebe {

Index deepest_vertex(BoundarySolver& surface, const VectorXd& areas)
{
    Index deepest = 0;
    surface.solve_interior(areas).values.maxCoeff(&deepest);
    return deepest;
}

Index deepest_vertex(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<char>& outer)
{
    const Index vertex_count = static_cast<Index>(outer.size());
    std::vector<Index> boundary;
    for (Index v = 0; v < vertex_count; ++v)
        if (outer[v]) boundary.push_back(v);
    if (static_cast<Index>(boundary.size()) == vertex_count) return -1;
    SparseMatrix laplacian = cotan_laplacian(triangles, half_cotangents(lengths), vertex_count);
    for (const Index v : boundary) laplacian.coeffRef(v, v) = 1.0;  // an unused vertex has no entry
    laplacian.makeCompressed();
    CondensedLaplacian surface(laplacian, boundary, static_cast<Index>(boundary.size()));
    const VectorXd torsion = surface.solve_interior(vertex_areas(triangles, lengths, vertex_count)).values;
    Index deepest = -1;
    for (Index v = 0; v < vertex_count; ++v)
        if (!outer[v] && (deepest < 0 || torsion[v] > torsion[deepest])) deepest = v;
    return deepest;
}

}  // namespace koebe
