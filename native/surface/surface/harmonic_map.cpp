#include "surface/harmonic_map.h"

#include "surface/harmonic_solver.h"

namespace koebe {

VectorXcd harmonic_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                       const std::vector<Index>& vertices, const VectorXcd& values)
{
    MatrixXd parts = MatrixXd::Zero(vertex_count, 2);
    for (std::size_t b = 0; b < vertices.size(); ++b) parts.row(vertices[b]) << values[b].real(), values[b].imag();
    parts = harmonic_solver(triangles, lengths, vertex_count, vertices).solve(parts);
    return parts.col(0) + Complex(0.0, 1.0) * parts.col(1);
}

}  // namespace koebe
