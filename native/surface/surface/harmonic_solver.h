// Many harmonic functions with values given at the same vertices, from one factorization.
#pragma once

#include "linear/sparse_cholesky.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// Solves with the cotan Laplacian and values given at some vertices; 0 at unused vertices.
/// @param triangles, lengths (F, 3) faces and their edge lengths
/// @throws SolverError
DirichletSolver harmonic_solver(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                                const std::vector<Index>& vertices);

}  // namespace koebe
