#include "iteration/grounded_state.h"

#include "linear/dense_spd.h"

#include <utility>

namespace koebe {

DenseGroundedState::DenseGroundedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                                       const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles)
    : GroundedState(loops, edges, std::move(first_angles)), surface_(surface), begin_(loops.size())
{
    std::vector<Index> first(loops.size() + 1, 0);
    for (int k = 1; k < loop_count(); ++k) first[k + 1] = first[k] + size_[k];
    for (int k = loop_count() - 1; k > 0; --k) {
        begin_[k] = static_cast<Index>(given_.size());
        for (Index b = 0; b < size_[k]; ++b) given_.push_back(first[k] + b);
    }
    const MatrixXd sigma = surface.sigma();
    const Index inner = static_cast<Index>(given_.size());
    sigma_ = sigma.bottomRightCorner(inner, inner)(given_, given_);
    if (!surface.grounded()) coupling_ = sigma.bottomLeftCorner(inner, size_[0]);
    filled_ = sigma_;
    fill();
    if (begun()) return;
    int raised = 0;
    for (int k = 1; k < loop_count(); ++k)
        take_angles({k}, sigma_.block(begin_[k], begin_[k], size_[k], size_[k]).rowwise().sum(), raised);
}

void DenseGroundedState::set_disk(int k, const MatrixXd& disk)
{
    filled_.block(begin_[k], begin_[k], size_[k], size_[k]) =
        sigma_.block(begin_[k], begin_[k], size_[k], size_[k]) + disk;
    stale_ = true;
}

const MatrixXd& DenseGroundedState::factor()
{
    if (std::exchange(stale_, false)) factor_ = spd_factor(filled_);
    return factor_;
}

/// A z = -Sigma_R0 z_0 on the inner loops R.
std::vector<VectorXcd> DenseGroundedState::images()
{
    const VectorXcd outer = rim();
    MatrixXd parts(size_[0], 2);
    parts << outer.real(), outer.imag();
    const MatrixXd load = surface_.grounded() ? surface_.load_of_grounded(parts) : MatrixXd(-(coupling_ * parts));
    MatrixXd z = load(given_, Eigen::all);
    const auto lower = factor().triangularView<Eigen::Lower>();
    lower.solveInPlace(z);
    lower.transpose().solveInPlace(z);
    std::vector<VectorXcd> result{outer};
    for (int k = 1; k < loop_count(); ++k) {
        const auto rows = z.middleRows(begin_[k], size_[k]);
        result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
    }
    return result;
}

std::vector<VectorXd> DenseGroundedState::fluxes_against_outer()
{
    const MatrixXd inverse_lower = lower_inverse(factor());
    std::vector<VectorXd> result;
    for (int k = 1; k < loop_count(); ++k) {
        const auto columns = inverse_lower.middleCols(begin_[k], size_[k]).bottomRows(inverse_lower.rows() - begin_[k]);
        result.push_back(spd_solve(gram(columns), VectorXd::Ones(size_[k])));
    }
    return result;
}

/// The solution of L' u = (0, L_11' 1) is 1 on the first inner loop and harmonic on the others.
VectorXd DenseGroundedState::outer_flux()
{
    VectorXd u = VectorXd::Zero(factor().rows());
    const auto last = factor().bottomRightCorner(size_[1], size_[1]).triangularView<Eigen::Lower>();
    u.tail(size_[1]) = last.transpose() * VectorXd::Ones(size_[1]);
    factor().triangularView<Eigen::Lower>().transpose().solveInPlace(u);
    VectorXd values(u.size());
    values(given_) = u;
    return surface_.grounded() ? surface_.flux_to_grounded(values) : VectorXd(-(coupling_.transpose() * values));
}

}  // namespace koebe
