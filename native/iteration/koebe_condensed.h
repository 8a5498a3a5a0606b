// The Koebe iteration on boundary angles alone: the condensed engine (docs/method.md).
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_outcome.h"
#include "linear/boundary_solver.h"

#include <memory>
#include <optional>
#include <vector>

namespace koebe {

/// The Laplacian of a surface with these loops, condensed as the iteration takes it best. An outer loop with a third of
/// all boundary vertices is grounded, unless they are few: then Sigma has the inner loops alone. Where more than
/// `most_condensed` boundary vertices would be kept there is no Sigma: a FilledLaplacian.
/// @param options where they let steps follow each other nothing is grounded
/// @param most_condensed without it 5 sqrt(V), and no more than 3,000; in turn 3,000
/// @throws SolverError
std::unique_ptr<BoundarySolver> condense(const SparseMatrix& laplacian, const std::vector<VertexLoop>& loops,
                                         const IterationOptions& options,
                                         std::optional<std::size_t> most_condensed = {});

/// Runs the iteration (paper, section 4.4) on the state of one angle per boundary vertex.
///
/// Every loop k is filled by a round disk whose Dirichlet-to-Neumann matrix T_k is known in closed form; A = Sigma +
/// sum T_k is the surface with all of them. A GK step opens the pair P = (i, j), the rest R staying filled: the
/// harmonic function f that is 0 on one loop and 1 on the other has f_R = -A_RR^-1 A_RP f_P, and the flux
/// A_PP f_P + A_PR f_R through its nodes has the conjugate function as its running sum: the new angles. (T_i and T_j
/// vanish on constants.) A CK step opens one loop, kept at 0, and a source inside S takes the place of the other. A
/// step of against_outer is a GK step on the pair (0, k).
///
/// All loops are opened from the same state, each against the outer one, and one factor of A serves them all: with N
/// the inverse of A on the inner loops, the flux through loop k at potential 1 is (N_kk)^-1 1. The outer loop, open in
/// every step, is never filled, and takes its angles from the flux of the pair (0, 1) in the new state. All methods are
/// then the same, but for how many loops a step counts. With one loop one step from a source is exact, with two loops
/// one GK step. Boundaries too long for a Sigma keep A as one sparse matrix, and the blocks N_kk come by selected
/// inversion.
///
/// CK and against_outer up to 8 loops, and all methods with IterationOptions::in_turn, take the steps of a sweep one
/// after the other, as the paper's theorems have them, and R is eliminated in each; but not where there is no Sigma.
///
/// @param laplacian of the surface
/// @param surface the same by condense(), with the same options
/// @param loops the outer loop first
/// @param edges per loop: length on the surface of the edge from each vertex to the next, all positive
/// @param areas (V) area around each vertex: for the choice of the source, the vertex deepest inside
/// @param last of the same loops on a surface of nearly the same shape: the iteration begins with its angles, and ends
/// as soon as the next sweep, changing the circles by the same share of this one's, would move them by less than a
/// third of the tolerance
/// @throws SolverError, Cancelled
KoebeOutcome koebe_condensed(const SparseMatrix& laplacian, BoundarySolver& surface,
                             const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                             const VectorXd& areas, const IterationOptions& options, ExecutionContext& context,
                             const KoebeOutcome* last = nullptr);

}  // namespace koebe
