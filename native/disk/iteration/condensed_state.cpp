#include "iteration/condensed_state.h"

#include "linear/dense_spd.h"

#include <algorithm>
#include <utility>

namespace koebe {

CondensedState::CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                               const std::vector<VectorXd>& edges, VectorXd source, std::vector<VectorXd> first_angles)
    : FilledState(loops, edges, std::move(first_angles)),
      source_(std::move(source)),
      sigma_(surface.sigma()),
      filled_(sigma_)
{
    Index begin = 0;
    for (const Index size : size_) {
        begin_.push_back(begin);
        begin += size;
    }
    fill();
    if (begun()) return;
    int raised = 0;
    for (int k = 0; k < loop_count(); ++k) take_angles({k}, diagonal_block(sigma_, k).rowwise().sum(), raised);
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

void CondensedState::set_disk(int k, const MatrixXd& disk)
{
    filled_.block(begin_[k], begin_[k], size_[k], size_[k]) = diagonal_block(sigma_, k) + disk;
}

void CondensedState::take_steps(const Sweep& together, int& raised)
{
    std::vector<VectorXd> fluxes;
    for (const OpenedLoops& open : together) fluxes.push_back(flux(open));
    for (std::size_t s = 0; s < together.size(); ++s) take_angles(together[s], fluxes[s], raised);
}

VectorXd CondensedState::flux(const OpenedLoops& open) const
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
