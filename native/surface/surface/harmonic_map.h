// Harmonic maps into the plane with given values on some vertices.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// Minimizes the Dirichlet energy (paper, equation 2) with z = values[b] at vertices[b].
/// @param triangles, lengths (F, 3) faces and their edge lengths
/// @return (V); 0 at unused vertices
/// @throws SolverError
KOEBE_API VectorXcd harmonic_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                                 const std::vector<Index>& vertices, const VectorXcd& values);

}  // namespace koebe
