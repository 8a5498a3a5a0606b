// The dilatation of the extremal map between two circle domains, from their circles alone.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "fit/dilatation_bounds.h"

#include <vector>

namespace koebe {

/// The largest factor by which a separation of two loops differs (conformal_separation): no map of one domain to the
/// other has a smaller dilatation. A map of dilatation K extends by reflections to the sphere, and changes the modulus
/// of a ring by the factor K at most.
/// @param a, b circle domains whose loops correspond by number
double separation_bound(const std::vector<Circle>& a, const std::vector<Circle>& b);

/// K of the extremal map, and a lower bound of it. Both depend on the circles alone, not on the mesh of a surface,
/// whose few vertices at a rim may span another domain than the circles do. So the way back has the same numbers. A
/// mesh of one domain, fine at the rims and in gaps, is bent onto the other (bend_between), and Reich's and Strebel's
/// inequalities give bounds of K and a quadratic differential q (dilatation_bounds). The map with mu = k conj(q) / |q|
/// (quasiconformal_map) gives better ones, and a better q, and so on. The way is the one from the domain with the
/// smaller sum of separations.
/// @param a, b circle domains whose loops correspond by number, three or more @throws SolverError, Cancelled
DilatationBounds domain_dilatation(const std::vector<Circle>& a, const std::vector<Circle>& b,
                                   ExecutionContext& context);

}  // namespace koebe
