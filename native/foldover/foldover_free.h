// Foldover-free planar maps: the regularized variational method of Garanzha et al. 2021.
#pragma once

#include "execution/execution.h"
#include "foldover/foldover_problem.h"

#include <functional>

namespace koebe {

struct FoldoverOptions {
    int max_iterations = 60;
    double area_weight = 1.0 / 128.0;  ///< of det + 1/det against the conformal term, dimensionless (Garanzha's theta)
    double settled = 1e-4;             ///< relative decrease at which a foldover-free map is good enough
    double least = 0.0;                ///< what the sum cannot fall below: decreases are relative to what is above it
    double stalled = 1e-4;             ///< and one at which a folded map is given up
    bool strict = false;               ///< no step over a floor: from a foldover-free map to foldover-free ones only
    double power = 1.0;                ///< s >= 1: see below
    double slack = 0.0;                ///< delta: see below
    /// Refuses points, asked last; empty: none. What is refused is the last step, which is shortened.
    std::function<bool(const PlanarPoints&)> refuses = {};
};

struct FoldoverResult {
    bool foldover_free = false;  ///< every determinant is above its floor
    int iterations = 0;
    bool hindered = false;  ///< it ended as points were refused
};

/// Minimizes sum_f (tr(J'J) / chi(det J - floor) + theta (det^2 + 1) / chi) over the mobile vertices, J the linear map
/// from the reference to the image, chi(D, eps) = (D + sqrt(eps^2 + D^2)) / 2, eps shrinking as the worst
/// determinant rises, and pull ((|z - c| - r) / r)^2, to centres pull (|z - c| / r)^2, over the pulled vertices
/// (Garanzha, Kaporin, Kudryavtseva, Protais, Ray and Sokolov 2021, "Foldover-free maps in 50 lines of code", sections
/// 2 and 3), by Newton's method on Hessians made positive semidefinite face by face. With a power s > 1 each term t
/// becomes (t / 2 - 1 + delta)^s: with theta = 0 that is (2 |mu|^2 / (1 - |mu|^2) + delta)^s, whose minimum feels
/// single vertices that are held however fine the mesh, and the greatest |mu| the more the larger s; delta keeps its
/// Hessian regular.
/// @return problem.points holds the result whether it is free of foldovers or not
FoldoverResult minimize_foldover_free(FoldoverProblem& problem, const ExecutionContext& context,
                                      const FoldoverOptions& options = {});

}  // namespace koebe
