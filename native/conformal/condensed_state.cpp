#include "conformal/condensed_state.h"

#include "geometry/dense_spd.h"

#include <algorithm>
#include <utility>

namespace koebe {

CondensedState::CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                               const std::vector<VectorXd>& edges, VectorXd source)
    : FilledState(loops, edges)
{
    const Index inner = static_cast<Index>(source.size()) - size_[0];
    begin_.assign(loops.size(), inner);
    for (int k = 1, begin = 0; k < loop_count(); begin += size_[k++]) begin_[k] = begin;
    // The outer loop comes first in what is given.
    source_.resize(source.size());
    source_ << source.tail(inner), source.head(size_[0]);
    const MatrixXd sigma = surface.sigma();
    sigma_.resize(sigma.rows(), sigma.cols());
    sigma_ << sigma.bottomRightCorner(inner, inner), sigma.bottomLeftCorner(inner, size_[0]),
        sigma.topRightCorner(size_[0], inner), sigma.topLeftCorner(size_[0], size_[0]);
    filled_ = sigma_;
    int raised = 0;
    for (int k = 0; k < loop_count(); ++k)
        take_angles({k}, diagonal_block(sigma_, k).rowwise().sum(), raised);
}

const MatrixXd& CondensedState::inner_factor()
{
    if (std::exchange(stale_, false)) inner_factor_ = spd_factor(filled_.topLeftCorner(begin_[0], begin_[0]));
    return inner_factor_;
}

/// L_RR L_RR' z = -A_R0 z_0.
std::vector<VectorXcd> CondensedState::images()
{
    const VectorXcd outer = rim();
    MatrixXd parts(size_[0], 2);
    parts << outer.real(), outer.imag();
    const auto lower = inner_factor().triangularView<Eigen::Lower>();
    MatrixXd z = -(filled_.topRightCorner(begin_[0], size_[0]) * parts);
    lower.solveInPlace(z);
    lower.transpose().solveInPlace(z);
    std::vector<VectorXcd> result{outer};
    for (int k = 1; k < loop_count(); ++k) {
        const auto rows = z.middleRows(begin_[k], size_[k]);
        result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
    }
    return result;
}

std::vector<VectorXd> CondensedState::fluxes(const std::vector<std::vector<int>>& open_sets)
{
    if (open_sets.size() == 1) return {eliminated_flux(open_sets[0])};
    // Constants are in the kernel of A: they are held at the outer loop.
    const MatrixXd inverse_lower = lower_inverse(bordered_factor(
        inner_factor(), filled_.bottomLeftCorner(size_[0], begin_[0]),
        filled_.bottomRightCorner(size_[0], size_[0]) + weights_[0] * weights_[0].transpose()));
    const VectorXd half = inverse_lower * source_;
    std::vector<VectorXd> result;
    for (const std::vector<int>& open : open_sets) {
        const VectorXd source_potential =
            open.size() == 1
                ? VectorXd(inverse_lower.middleCols(begin_[open[0]], size_[open[0]]).transpose() * half)
                : VectorXd();
        result.push_back(flux_by_inverse(open, inverse_block(open, inverse_lower), source_potential, source_.sum()));
    }
    return result;
}

/// M_PP = |L^-1 E_P|^2; the columns of a loop are zero above its rows.
MatrixXd CondensedState::inverse_block(const std::vector<int>& open, const MatrixXd& inverse_lower) const
{
    const auto columns = [&](int k, Index from) {
        return inverse_lower.middleCols(begin_[k], size_[k]).bottomRows(inverse_lower.rows() - from);
    };
    MatrixXd result(total(open), total(open));
    const Index first = size_[open[0]];
    result.topLeftCorner(first, first) = gram(columns(open[0], begin_[open[0]]));
    if (open.size() == 2) {
        const Index second = size_[open[1]], common = std::max(begin_[open[0]], begin_[open[1]]);
        result.bottomRightCorner(second, second) = gram(columns(open[1], begin_[open[1]]));
        result.bottomLeftCorner(second, first) = transpose_times(columns(open[1], common), columns(open[0], common));
        result.topRightCorner(first, second) = result.bottomLeftCorner(second, first).transpose();
    }
    return result;
}

void CondensedState::set_disk(int k, const MatrixXd& disk)
{
    filled_.block(begin_[k], begin_[k], size_[k], size_[k]) = diagonal_block(sigma_, k) + disk;
    stale_ = true;
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
