// Maps a closed surface to the sphere.
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_outcome.h"
#include "quality/report.h"
#include "surface/periodic_surface.h"

#include <vector>

namespace koebe {

/// A map of a closed surface to the plane; no vertex is at infinity.
struct ClosedSphereMap {
    VectorXcd z;  ///< (V) finite; balanced (spherical_balance.h), up to a rotation of the sphere
    bool converged = false;
    std::vector<double> changes;  ///< largest move of a point on the sphere in each sweep
    StageSeconds seconds;         ///< metric, factor and iterate
};

/// The conformal map of a closed surface of genus 0 to the sphere.
///
/// The start opens one face. The function with a dipole in that face is conformal up to the mesh's resolution
/// (Angenent, Haker, Tannenbaum and Kikinis 1999). Of some faces far from each other, the one that turns the fewest
/// faces over is taken. Its error is of first order. Then two overlapping caps cover the sphere. Stereographic
/// projection from the middle of the other cap shows each in the plane, where conformal maps are harmonic. In turn each
/// cap is mapped harmonically, with the other's values on its rim (Schwarz 1870), and the whole is balanced. An error
/// z^k falls by 9^-k in a sweep; z^0 and z^1 are Moebius maps. The remaining error is of second order everywhere.
///
/// Faces that the start makes large on the sphere are split first, which does not change the surface.
/// @param domain without loops @param weights (V) area around each vertex
/// @throws SolverError, Cancelled
ClosedSphereMap closed_sphere_map(const PeriodicSurface& domain, const VectorXd& weights,
                                  const IterationOptions& options, ExecutionContext& context);

}  // namespace koebe
