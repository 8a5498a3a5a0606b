// Angles and curvature of a metric given by edge lengths.
#pragma once

#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// (F, 3) angle at each corner, in radians, of sum pi in every face. Where an edge is longer than the two others
/// together, the angle opposite to it is pi and the others are 0: the extension that keeps the energies of discrete
/// conformal maps convex for all lengths (Bobenko, Pinkall, Springborn 2015; Luo 2011).
EdgeLengths corner_angles(const EdgeLengths& lengths);

/// (V) discrete curvature in radians: 2 pi less the angles around an inner vertex, pi less those at a boundary vertex.
/// The sum is 2 pi chi (Gauss-Bonnet). 0 at vertices of no face.
VectorXd discrete_curvature(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<char>& boundary);

/// Faces that break the triangle inequality, or just meet it: a metric in which there are any is none.
std::vector<Index> collapsed_faces(const EdgeLengths& lengths);

}  // namespace koebe
