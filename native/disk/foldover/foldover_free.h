// Foldover-free planar maps: the regularized variational method of Garanzha et al. 2021.
#pragma once

#include "execution/execution.h"
#include "foldover/foldover_problem.h"

#include <functional>

namespace koebe {

struct NewtonPattern;

struct FoldoverOptions {
    int max_iterations = 60;
    double area_weight = 1.0 / 128.0;  ///< weight of det + 1/det against the conformal term (Garanzha's theta)
    double settled = 1e-4;             ///< relative decrease at which a foldover-free map is finished
    double least = 0.0;                ///< lower bound of the sum: relative decreases are of the sum minus this bound
    double stalled = 1e-4;             ///< relative decrease at which a folded map is given up
    bool strict = false;               ///< no step crosses a floor: a foldover-free map stays foldover-free
    double power = 1.0;                ///< s >= 1: see below
    double slack = 0.0;                ///< delta: see below
    double scale = 1.0;                ///< c: see below
    /// The pattern of the last problem with the same triangles and lifts, or an empty one; it holds the pattern of this
    /// problem afterwards. Null: the pattern is made anew.
    NewtonPattern* pattern = nullptr;
    /// The last test of a step: it can refuse points, and then the step is shortened. Empty: no test.
    std::function<bool(const FoldoverPlaces&)> refuses = {};
};

struct FoldoverResult {
    bool foldover_free = false;  ///< every determinant is above its floor
    int iterations = 0;
    bool hindered = false;  ///< the minimization ended because points were refused
};

/// Minimizes sum_f (tr(J'J) / chi(det J - floor) + theta (det^2 + 1) / chi) over the mobile vertices. J is the linear
/// map from the reference to the image, chi(D, eps) = (D + sqrt(eps^2 + D^2)) / 2, and eps shrinks as the worst
/// determinant rises. Pulled vertices add pull ((|z - c| - r) / r)^2, or pull (|z - c| / r)^2 if pulled to centres.
/// (Garanzha, Kaporin, Kudryavtseva, Protais, Ray and Sokolov 2021, "Foldover-free maps in 50 lines of code", sections
/// 2 and 3; docs/numerics.md, "Flips", N5.) Uses Newton's method on Hessians made positive semidefinite face by face.
/// With a power s > 1 each term t becomes ((t / 2 - 1 + delta) / c)^s. With theta = 0 this is ((2 |mu|^2 / (1 - |mu|^2)
/// + delta) / c)^s. With s > 1 single held vertices change the minimum on fine meshes, too. A larger s lowers the
/// greatest |mu| more; delta keeps the Hessian regular, and a c near the largest t / 2 - 1 keeps large powers in the
/// range of doubles.
/// @return problem.points holds the result, with or without foldovers
FoldoverResult minimize_foldover_free(FoldoverProblem& problem, const ExecutionContext& context,
                                      const FoldoverOptions& options = {});

/// The largest 2 |mu|^2 / (1 - |mu|^2) of the first faces, from their wanted shapes to their images; for theta = 0 it
/// is the largest t / 2 - 1. A face that is turned over counts as |mu| = 1, so as infinite. @param count of faces
double most_bent(const FoldoverProblem& problem, Eigen::Index count);

}  // namespace koebe
