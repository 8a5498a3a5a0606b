// A map of a periodic surface into the plane, up to its periods.
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"
#include "surface/periodic_surface.h"

#include <vector>

namespace koebe {

struct FlatMap {
    VectorXcd z;                       ///< (V) one of each vertex's positions
    std::vector<Complex> periods;      ///< one for each shift of the surface
    std::vector<Circle> circles;       ///< of the holes, if they are circles
    std::vector<Roundness> roundness;  ///< of the holes' images before they were put on the circles
    std::vector<Index> off_circle;     ///< vertices off their hole's circle or slit, ascending
    std::vector<double> changes;       ///< change of the circles in each sweep
    bool converged = true;
    bool apart = true;  ///< whether no circle meets another
};

/// Whether no circle meets another circle, or a copy moved by a lattice vector near 0.
/// @param periods one or two
bool apart_in_tile(const std::vector<Circle>& circles, const std::vector<Complex>& periods);

/// The load of a form's jumps: with K u = load, du + form is harmonic. @param form on the metric's half-edges
VectorXd jump_load(const PeriodicSurface& domain, const OneForm& form);

SparseMatrix laplacian_of(const PeriodicSurface& domain);

/// Moves loop vertices to new places, and the inside by the harmonic extension of the displacements. A map that was
/// harmonic up to its jumps stays so.
/// @param moved (V) 1 for the vertices whose new place is given; other loop vertices stay
void move_boundary(const PeriodicSurface& domain, const VectorXcd& places, const std::vector<char>& moved,
                   VectorXcd& z);

}  // namespace koebe
