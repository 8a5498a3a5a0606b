// A closed surface on the sphere.
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_outcome.h"
#include "surface/periodic_surface.h"

#include <vector>

namespace koebe {

/// A map of a closed surface to the plane and the point at infinity, none of its vertices there.
struct ClosedSphereMap {
    VectorXcd z;  ///< (V) finite; balanced (spherical_balance.h), up to a rotation of the sphere
    bool converged = false;
    std::vector<double> changes;  ///< largest move of a point of the sphere in each sweep
};

/// The conformal map of a closed surface of genus 0 to the sphere.
///
/// A start: one face opened. The function with a dipole in that face is conformal up to the resolution of the mesh
/// (Angenent, Haker, Tannenbaum and Kikinis 1999); among some faces, far from each other, the one is taken that turns
/// the fewest faces over. Its error is of first order. So the sphere is then covered by two caps that overlap, each in
/// the plane by the stereographic projection from the middle of the other one, where conformal maps are harmonic. In
/// turn each of them is mapped harmonically, its rim as the other one has it (Schwarz 1870), and the whole balanced.
/// An error z^k falls by 9^-k in a sweep; z^0 and z^1 are Moebius maps. What is left is of second order everywhere.
///
/// Faces that the start shows large on the sphere are split first, as a polyhedron's: the surface stays as it is.
/// @param domain without loops @param weights (V) area around each vertex
/// @throws SolverError, Cancelled
ClosedSphereMap closed_sphere_map(const PeriodicSurface& domain, const VectorXd& weights,
                                  const IterationOptions& options, ExecutionContext& context);

}  // namespace koebe
