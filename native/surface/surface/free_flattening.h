// The least squares conformal map of a disk of triangles with free boundary and two vertices pinned.
#pragma once

#include "core/types.h"

namespace koebe {

/// LSCM (Levy, Petitjean, Ray and Maillot 2002, section 2): minimizes the area-weighted squared violation of the
/// Cauchy-Riemann equations. A face thinner than 1e-3 of its longest edge counts as that thick.
/// @param vertices (V, 3) @param triangles (F, 3) a disk with counter-clockwise faces that names every vertex
/// @return (V) images
/// @throws SolverError
VectorXcd flatten_freely(const Vertices& vertices, const Triangles& triangles, Index first, Complex first_image,
                         Index second, Complex second_image);

}  // namespace koebe
