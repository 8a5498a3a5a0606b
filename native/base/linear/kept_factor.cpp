#include "linear/kept_factor.h"

#include "core/errors.h"

namespace koebe {

const SparseCholesky& factored(KeptFactor& kept, const SparseMatrix& matrix)
{
    if (kept)
        kept->refactorize(matrix);
    else
        kept.emplace(matrix);
    return *kept;
}

std::pair<VectorXd, double> newton_descent(SparseMatrix& hessian, const VectorXd& gradient, double shift,
                                           KeptFactor& kept)
{
    for (Eigen::Index i = 0; i < hessian.cols(); ++i) {
        double& diagonal = hessian.valuePtr()[hessian.outerIndexPtr()[i]];
        diagonal = diagonal > 0.0 ? (1.0 + shift) * diagonal : 1.0;
    }
    VectorXd step = VectorXd::Zero(gradient.size());
    try {
        step = -factored(kept, hessian).solve(gradient);
    } catch (const SolverError&) {
        kept.reset();
    }
    double slope = gradient.dot(step);
    if (!(slope < 0.0) || !step.allFinite()) {
        step = -gradient.cwiseQuotient(hessian.diagonal().cwiseMax(1e-300));
        slope = gradient.dot(step);
    }
    return {std::move(step), slope};
}

}  // namespace koebe
