#include "conformal/condensed_state.h"

#include "geometry/dense_spd.h"

#include <algorithm>
#include <utility>

namespace koebe {

CondensedState::CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                               const std::vector<VectorXd>& edges, VectorXd source)
    : FilledState(loops, edges), begin_(loops.size())
{
    std::vector<Index> given, rows;  // where each loop begins in what is given; the given row of each row here
    Index total = 0;
    for (const VertexLoop& loop : loops) {
        given.push_back(total);
        total += static_cast<Index>(loop.size());
    }
    for (int k = loop_count() - 1; k >= 0; --k) {
        begin_[k] = static_cast<Index>(rows.size());
        for (Index b = 0; b < size_[k]; ++b) rows.push_back(given[k] + b);
    }
    source_ = source(rows);
    sigma_ = surface.sigma()(rows, rows);
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

std::vector<VectorXd> CondensedState::fluxes_against_outer()
{
    const MatrixXd inverse_lower = lower_inverse(inner_factor());
    std::vector<VectorXd> result;
    for (int k = 1; k < loop_count(); ++k) {
        const auto columns = inverse_lower.middleCols(begin_[k], size_[k]).bottomRows(begin_[0] - begin_[k]);
        result.push_back(spd_solve(gram(columns), VectorXd::Ones(size_[k])));
    }
    return result;
}

/// L' u = (0, L_11' 1) is 1 on the first inner loop and harmonic on the others.
VectorXd CondensedState::outer_flux()
{
    VectorXd u = VectorXd::Zero(begin_[0]);
    const auto lower = inner_factor().triangularView<Eigen::Lower>();
    const auto last = inner_factor().bottomRightCorner(size_[1], size_[1]).triangularView<Eigen::Lower>();
    u.tail(size_[1]) = last.transpose() * VectorXd::Ones(size_[1]);
    lower.transpose().solveInPlace(u);
    return -(sigma_.bottomLeftCorner(size_[0], begin_[0]) * u);
}

void CondensedState::set_disk(int k, const MatrixXd& disk)
{
    filled_.block(begin_[k], begin_[k], size_[k], size_[k]) = diagonal_block(sigma_, k) + disk;
    if (k > 0) stale_ = true;
}

VectorXd CondensedState::flux(const std::vector<int>& open)
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
