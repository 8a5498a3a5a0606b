// Bounds of the least dilatation of all maps that a given map can be moved to, from quadratic differentials.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <cmath>
#include <vector>

namespace koebe {

/// Both are equal for a Teichmueller map: mu = k conj(q) / |q| with a holomorphic quadratic differential q that is real
/// on the rims.
struct DilatationBounds {
    double lower = 1.0;  ///< no map has a smaller largest dilatation
    double upper = 1.0;  ///< the map's dilatation along q, in the mean
    VectorXcd q;         ///< (F), of `lower`; empty for a conformal map

    double dilatation() const { return std::sqrt(lower * upper); }
};

/// Let I(q) be the integral of |q| |1 + mu q / |q||^2 / (1 - |mu|^2), for q with the integral of |q| 1. For every such
/// q the extremal dilatation is at least 1 / I(-q), and at most the greatest I(q) (Reich and Strebel 1974). An error of
/// the map or of q changes both in second order only.
///
/// q is a sum of products of the forms du/dz of harmonic measures u. They span all such q (M. Noether), unless the
/// domain's double is hyperelliptic, as it is if all centres lie on a line. Then products of a Green's function's form
/// and a form that vanishes at its pole span the others. The sum is that of least norm whose pairing with mu is 1. The
/// bounds are those of smooth maps up to the error of the mesh.
///
/// Of maps that also keep marked points, q may have a simple pole at each. Then the products have more factors: forms
/// with poles at two marks of rims (landmark_forms), and Green's functions' forms with their poles at marks inside. No
/// product has a double pole.
/// @param uv (V, 2) the domain @param circles of the rims, the unit circle first @param loops rims, all vertices
/// @param marks vertices, each once @param mu (F) from the domain
/// @throws SolverError
DilatationBounds dilatation_bounds(const Triangles& triangles, const PlanarPoints& uv,
                                   const std::vector<Circle>& circles, const std::vector<VertexLoop>& loops,
                                   const std::vector<Index>& marks, const VectorXcd& mu);

}  // namespace koebe
