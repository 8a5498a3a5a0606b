// Newton's method for the convex energies of discrete conformal metrics.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "linear/kept_factor.h"

#include <string>
#include <vector>

namespace koebe {

/// A convex function of one number per vertex that does not change when a constant is added to all: the gradient sums
/// to 0, and the constants are in the kernel of the Hessian.
class ConvexEnergy {
public:
    virtual ~ConvexEnergy() = default;
    virtual VectorXd gradient(const VectorXd& u) = 0;
    /// The Hessian at the point of the last gradient; both triangles stored, positive semidefinite.
    virtual SparseMatrix hessian() const = 0;
};

struct NewtonOptions {
    double tolerance = 1e-10;  ///< on the largest entry of the gradient, radians
    int max_steps = 50;
};

struct NewtonReport {
    bool converged = false;
    int steps = 0;
    std::vector<double> residuals;  ///< largest entry of the gradient, at the start and after each step
    std::string reason;             ///< why it stopped before it converged
};

/// Keeps the symbolic factorization as long as the Hessian's pattern stays.
class ConvexNewton {
public:
    /// Minimizes the energy, starting at u. A step is halved until the derivative along it is at most half of the first
    /// one, which a convex energy with a continuous gradient reaches. The energy itself is not used, as its differences
    /// are lost to round-off near the minimum. The mean of u does not change.
    /// @throws Cancelled
    NewtonReport minimize(ConvexEnergy& energy, VectorXd& u, const NewtonOptions& options, ExecutionContext& context);

private:
    VectorXd solve(SparseMatrix hessian, const VectorXd& right);

    std::vector<Index> pattern_;
    KeptFactor factor_;
};

}  // namespace koebe
