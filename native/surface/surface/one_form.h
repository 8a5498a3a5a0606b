// Discrete 1-forms: one number per half-edge, the integral along it (paper, section 4.1).
#pragma once

#include "core/types.h"
#include "surface/laplacian.h"

namespace koebe {

/// (3F) integral along half-edge h = 3 f + k, from corner k of face f to the next. A form on the surface has opposite
/// values on the two half-edges of an edge. Each face has values of its own, so that a function on a sliced mesh (one
/// value per corner) has a derivative too.
using OneForm = VectorXd;

/// df: value at the target minus value at the origin. @param f (V)
OneForm exterior_derivative(const Triangles& triangles, const VectorXd& f);

/// df for a function with a value per corner (3F), as on a mesh sliced along a path.
OneForm exterior_derivative_of_corners(const VectorXd& f);

/// (F) sum of the form around each face. It is 0 for a closed form.
VectorXd circulation(const OneForm& form);

/// (V) divergence by the cotan formula: the sum of cotan weight times value over the edges that leave the vertex. For a
/// harmonic form it is 0 inside (paper, equation 3), and on a boundary without flow. div df = -K f.
/// @param half_cotangents (F, 3) as for the Laplacian
VectorXd divergence(const Triangles& triangles, const EdgeLengths& half_cotangents, const OneForm& form,
                    Index vertex_count);

/// Integral of |form|^2, the Dirichlet energy without the factor 1/2.
double squared_norm(const EdgeLengths& half_cotangents, const OneForm& form);

/// Integral of a wedge b over the surface. Exact for closed forms, which are linear in each face.
double wedge_integral(const OneForm& a, const OneForm& b);

}  // namespace koebe
