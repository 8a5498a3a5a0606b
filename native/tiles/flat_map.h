// A map of a periodic surface into the plane, up to its periods.
#pragma once

#include "circles/circle_fit.h"
#include "core/types.h"
#include "surface/periodic_surface.h"

#include <vector>

namespace koebe {

struct FlatMap {
    VectorXcd z;                       ///< (V) one position of each vertex
    std::vector<Complex> periods;      ///< of each shift of the surface
    std::vector<Circle> circles;       ///< of the holes, where they are circles
    std::vector<Roundness> roundness;  ///< of their images before they were put on them
    std::vector<Index> off_circle;     ///< hole vertices that are not where their hole has them, rising
    std::vector<double> changes;       ///< of the circles in each sweep
    bool converged = true;
    bool apart = true;  ///< whether no circle meets another
};

/// The load of a form's jumps: u with K u = load makes du + form harmonic. @param form of the metric's half-edges
VectorXd jump_load(const PeriodicSurface& domain, const OneForm& form);

SparseMatrix laplacian_of(const PeriodicSurface& domain);

/// Moves vertices of loops to new places, and the inside by the harmonic extension of the displacements. What was
/// harmonic up to its jumps is so again.
/// @param moved (V) 1 for the vertices whose new place is given; the others of loops stay
void move_boundary(const PeriodicSurface& domain, const VectorXcd& places, const std::vector<char>& moved,
                   VectorXcd& z);

}  // namespace koebe
