// The Koebe iteration on boundary angles alone: the condensed engine (docs/method.md).
#pragma once

#include "conformal/result.h"
#include "core/execution.h"
#include "geometry/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// What a Koebe iteration of either engine hands to the finish.
struct KoebeOutcome {
    std::vector<VectorXcd> loops;  ///< image of each loop in the unit disk: the first on the unit circle, the others
                                   ///< round up to the resolution of the mesh
    std::vector<KoebeStep> history;
    int sweeps = 0, steps = 0;
    bool converged = false;
    int raised_angles = 0;         ///< boundary nodes whose flux vanished in the last sweep
};

/// Runs the iteration (paper, section 4.4) on the state of one angle per boundary vertex.
///
/// Every loop k is filled by a round disk whose Dirichlet-to-Neumann matrix T_k is known in closed form, and
/// M = (Sigma + sum T_k + alpha 1 1')^-1. The pair P = (i, j), opened, has the harmonic function with a on one loop
/// and a + 1 on the other; the flux through its nodes is (M_PP)^-1 (a, a + 1), since T_i and T_j vanish on constants,
/// and its running sum is the conjugate function: the new angles. a is such that no net flux runs and alpha is not felt. All pairs of a sweep start from the same state.
/// GK opens disjoint pairs, (0,1), (2,3), ...; CK opens (0,k) for each k. With one loop the flux comes from a
/// point source inside instead, and no iteration is needed; with two loops one step is exact.
///
/// @param surface the condensed Laplacian, its boundary the concatenation of the loops
/// @param loops the outer loop first
/// @param edges per loop: length on the surface of the edge from each vertex to the next, all positive
/// @param areas (V) area around each vertex: with one loop, the source sits where the torsion function, K u = area,
///        is largest, the vertex deepest inside
/// @throws SolverError, Cancelled
KoebeOutcome koebe_condensed(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                             const std::vector<VectorXd>& edges, const VectorXd& areas,
                             const UniformizeOptions& options, ExecutionContext& context);

}  // namespace koebe
