#include "conformal/condensed_state.h"

#include "geometry/dense_spd.h"

#include <algorithm>
#include <utility>

namespace koebe {

CondensedState::CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                               const std::vector<VectorXd>& edges, VectorXd source)
    : FilledState(loops, edges), source_(std::move(source)), sigma_(surface.sigma()), filled_(sigma_)
{
    int raised = 0;
    for (int k = 0; k < loop_count(); ++k)
        take_angles({k}, diagonal_block(sigma_, k).rowwise().sum(), raised);
}

std::vector<VectorXcd> CondensedState::images()
{
    const VectorXcd outer = rim();
    MatrixXd parts(size_[0], 2);
    parts << outer.real(), outer.imag();
    const Index rest = static_cast<Index>(filled_.rows()) - size_[0];
    const MatrixXd z =
        spd_solve(filled_.bottomRightCorner(rest, rest), -(filled_.bottomLeftCorner(rest, size_[0]) * parts));
    std::vector<VectorXcd> result{outer};
    for (int k = 1; k < loop_count(); ++k) {
        const auto rows = z.middleRows(begin_[k] - size_[0], size_[k]);
        result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
    }
    return result;
}

std::vector<VectorXd> CondensedState::fluxes(const std::vector<std::vector<int>>& open_sets)
{
    if (open_sets.size() == 1) return {eliminated_flux(open_sets[0])};
    // M = (A + alpha 1 1')^-1: constants are in the kernel of A.
    MatrixXd inverse = filled_;
    inverse.array() += filled_.diagonal().mean() / static_cast<double>(filled_.rows());
    inverse = spd_inverse(std::move(inverse));
    std::vector<VectorXd> result;
    for (const std::vector<int>& open : open_sets) result.push_back(flux_by_inverse(open, inverse));
    return result;
}

void CondensedState::set_disk(int k, const MatrixXd& disk)
{
    filled_.block(begin_[k], begin_[k], size_[k], size_[k]) = diagonal_block(sigma_, k) + disk;
}

VectorXd CondensedState::eliminated_flux(const std::vector<int>& open) const
{
    std::vector<int> rest;
    for (int k = 0; k < loop_count(); ++k)
        if (std::find(open.begin(), open.end(), k) == open.end()) rest.push_back(k);
    const auto load = [&](const std::vector<int>& rows) -> VectorXd {
        if (open.size() == 1) return -gather(source_, rows);
        return gather(sigma_, rows, {open[1]}).rowwise().sum();
    };
    if (rest.empty()) return load(open);
    return load(open) - gather(filled_, open, rest) * spd_solve(gather(filled_, rest, rest), load(rest));
}

/// M_PP q is the function on P up to a constant, which is such that no net flux runs: such a flux has a potential of
/// mean 0 and does not feel alpha.
VectorXd CondensedState::flux_by_inverse(const std::vector<int>& open, const MatrixXd& inverse) const
{
    const Index count = total(open);
    MatrixXd values = MatrixXd::Ones(count, 2);
    double net = 0.0;
    if (open.size() == 1) {
        values.col(0) = inverse.middleRows(begin_[open[0]], count) * source_;
        net = source_.sum();
    } else {
        values.col(0).head(size_[open[0]]).setZero();
    }
    const MatrixXd fluxes = spd_solve(gather(inverse, open, open), values);
    return fluxes.col(0) - (fluxes.col(0).sum() - net) / fluxes.col(1).sum() * fluxes.col(1);
}

MatrixXd CondensedState::gather(const MatrixXd& matrix, const std::vector<int>& rows,
                               const std::vector<int>& columns) const
{
    MatrixXd result(total(rows), total(columns));
    Index left = 0;
    for (const int c : columns) {
        Index top = 0;
        for (const int r : rows) {
            result.block(top, left, size_[r], size_[c]) = matrix.block(begin_[r], begin_[c], size_[r], size_[c]);
            top += size_[r];
        }
        left += size_[c];
    }
    return result;
}

VectorXd CondensedState::gather(const VectorXd& vector, const std::vector<int>& rows) const
{
    VectorXd result(total(rows));
    Index top = 0;
    for (const int r : rows) {
        result.segment(top, size_[r]) = vector.segment(begin_[r], size_[r]);
        top += size_[r];
    }
    return result;
}

}  // namespace koebe
