// The least squares conformal map of a disk of triangles with free boundary and some vertices pinned.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// LSCM (Levy, Petitjean, Ray and Maillot 2002, section 2): minimizes the area-weighted squared violation of the
/// Cauchy-Riemann equations. A face thinner than 1e-3 of its longest edge counts as that thick.
/// @param vertices (V, 3) @param triangles (F, 3) a disk with counter-clockwise faces that names every vertex
/// @param pinned vertices that keep these images, at least two @return (V) images
/// @throws SolverError
VectorXcd flatten_freely(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& pinned,
                         const std::vector<Complex>& images);

}  // namespace koebe
