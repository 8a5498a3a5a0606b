// Angles and curvature of a metric given by edge lengths.
#pragma once

#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// (F, 3) angle at each corner, radians, with sum pi in every face. Where an edge is longer than the two others
/// together, its opposite angle is pi and the others are 0. This extension keeps the energies of discrete conformal
/// maps convex for all lengths (Bobenko, Pinkall, Springborn 2015; Luo 2011).
EdgeLengths corner_angles(const EdgeLengths& lengths);

/// (V) discrete curvature in radians: 2 pi less the angles around an inner vertex, pi less the angles at a boundary
/// vertex. The sum is 2 pi chi (Gauss-Bonnet). 0 at unused vertices.
VectorXd discrete_curvature(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<char>& boundary);

/// Faces that break the triangle inequality or meet it with equality. A valid metric has no such face.
std::vector<Index> collapsed_faces(const EdgeLengths& lengths);

}  // namespace koebe
