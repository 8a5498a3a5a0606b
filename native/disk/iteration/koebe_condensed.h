// The Koebe iteration on boundary angles alone: the condensed engine (docs/method.md).
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_outcome.h"
#include "linear/condensed_laplacian.h"
#include "linear/filled_laplacian.h"

#include <memory>
#include <optional>
#include <vector>

namespace koebe {

/// The factored Laplacian of a surface: one of the two solvers, or none before it is factored.
struct FactoredSurface {
    std::unique_ptr<CondensedLaplacian> dense;  ///< has a Sigma
    std::unique_ptr<FilledLaplacian> sparse;    ///< for long boundaries, without a Sigma

    explicit operator bool() const { return dense || sparse; }
    BoundarySolver& solver() const { return dense ? static_cast<BoundarySolver&>(*dense) : *sparse; }
};

/// Condenses the Laplacian of a surface with these loops as the iteration needs it. Grounds an outer loop with a third
/// of all boundary vertices, unless these are few; then Sigma has the inner loops only. There is no Sigma where more
/// than `most_condensed` boundary vertices would be kept.
/// @param options with steps one after another nothing is grounded
/// @param most_condensed default 5 sqrt(V), at most 3,000; with steps one after another 3,000
/// @throws SolverError
FactoredSurface condense(const SparseMatrix& laplacian, const std::vector<VertexLoop>& loops,
                         const IterationOptions& options, std::optional<std::size_t> most_condensed = {});

/// Runs the iteration (paper, section 4.4) on the state of one angle per boundary vertex.
///
/// A round disk with Dirichlet-to-Neumann matrix T_k in closed form fills each loop k; A = Sigma + sum T_k is the
/// surface with all disks. A GK step opens the pair P = (i, j), the rest R stays filled. The harmonic function f that
/// is 0 on one loop and 1 on the other has f_R = -A_RR^-1 A_RP f_P. The running sum of the flux A_PP f_P + A_PR f_R
/// through its nodes is the conjugate function, which gives the new angles. (T_i and T_j vanish on constants.) A CK
/// step opens one loop, held at 0, and a source inside S replaces the other loop. A step of against_outer is a GK step
/// on the pair (0, k).
///
/// All loops are opened from the same state, each against the outer one, and one factor of A serves all steps: with N
/// the inverse of A on the inner loops, the flux through loop k at potential 1 is (N_kk)^-1 1. The outer loop, open in
/// every step, is never filled; its angles come from the flux of the pair (0, 1) in the new state. The methods then
/// differ only in how many loops a step counts. With one loop one step from a source is exact, with two loops one GK
/// step. Where the boundary is too long for a Sigma, A is one sparse matrix, and selected inversion gives the blocks
/// N_kk.
///
/// CK and against_outer up to 8 loops, and all methods with IterationOptions::gauss_seidel, take the steps of a sweep
/// one after another, as in the paper's theorems. Each step eliminates R. Without a Sigma this is not possible.
///
/// @param laplacian of the surface
/// @param surface condense() of the Laplacian with the same options
/// @param loops the outer loop first
/// @param edges per loop: length on the surface of the edge from each vertex to the next, all positive
/// @param areas (V) area around each vertex, to choose the source: the vertex deepest inside
/// @param last result for the same loops on a surface of nearly the same shape. The iteration starts with its angles.
/// It ends as soon as the next sweep would move the circles by less than a third of the tolerance, if it contracts the
/// change by the same factor
/// @throws SolverError, Cancelled
KoebeOutcome koebe_condensed(const SparseMatrix& laplacian, const FactoredSurface& surface,
                             const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                             const VectorXd& areas, const IterationOptions& options, ExecutionContext& context,
                             const KoebeOutcome* last = nullptr);

}  // namespace koebe
