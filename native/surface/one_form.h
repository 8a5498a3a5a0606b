// Discrete 1-forms: one number per half-edge, the integral along it (paper, section 4.1).
#pragma once

#include "core/types.h"
#include "surface/laplacian.h"

namespace koebe {

/// (3F) integral along half-edge h = 3 f + k, from corner k of face f to the next. A form on the surface has
/// opposite values on the two half-edges of an edge; each face sees its own, so that a function on a sliced mesh
/// (one value per corner) has a derivative too.
using OneForm = VectorXd;

/// df: value at the target minus value at the origin. @param f (V)
OneForm exterior_derivative(const Triangles& triangles, const VectorXd& f);

/// The same for a function with a value per corner (3F), as on a mesh sliced along a path.
OneForm exterior_derivative_of_corners(const VectorXd& f);

/// (F) sum around each face; 0 for a closed form.
VectorXd circulation(const OneForm& form);

/// (V) divergence by the cotan formula: sum of cotan weight times value over the edges that leave the vertex. 0 inside
/// for a harmonic form (paper, equation 3), and on a boundary that nothing flows through. div df = -K f.
/// @param half_cotangents (F, 3) as of the Laplacian
VectorXd divergence(const Triangles& triangles, const EdgeLengths& half_cotangents, const OneForm& form,
                    Index vertex_count);

/// Integral of |form|^2, the Dirichlet energy without the factor 1/2.
double squared_norm(const EdgeLengths& half_cotangents, const OneForm& form);

/// Integral of a wedge b over the surface, both closed: exact for forms that are linear in each face.
double wedge_integral(const OneForm& a, const OneForm& b);

}  // namespace koebe
