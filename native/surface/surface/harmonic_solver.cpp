#include "surface/harmonic_solver.h"

namespace koebe {

DirichletSolver harmonic_solver(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                                const std::vector<Index>& vertices)
{
    std::vector<char> fixed(vertex_count, 1);  // unused vertices stay at 0
    for (Eigen::Index i = 0; i < triangles.size(); ++i) fixed[triangles.data()[i]] = 0;
    for (const Index v : vertices) fixed[v] = 1;
    return {cotan_laplacian(triangles, half_cotangents(lengths), vertex_count), fixed};
}

}  // namespace koebe
