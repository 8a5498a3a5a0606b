#include "surface/harmonic_map.h"

#include "linear/sparse_cholesky.h"

namespace koebe {

VectorXcd harmonic_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                       const std::vector<Index>& vertices, const VectorXcd& values)
{
    std::vector<char> fixed(vertex_count, 1);  // unused vertices stay at 0
    for (Eigen::Index i = 0; i < triangles.size(); ++i) fixed[triangles.data()[i]] = 0;
    MatrixXd parts = MatrixXd::Zero(vertex_count, 2);
    for (std::size_t b = 0; b < vertices.size(); ++b) {
        fixed[vertices[b]] = 1;
        parts.row(vertices[b]) << values[b].real(), values[b].imag();
    }
    const SparseMatrix laplacian = cotan_laplacian(triangles, half_cotangents(lengths), vertex_count);
    parts = DirichletSolver(laplacian, fixed).solve(parts);
    return parts.col(0) + Complex(0.0, 1.0) * parts.col(1);
}

}  // namespace koebe
