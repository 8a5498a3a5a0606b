#include "iteration/sparse_state.h"

#include "linear/dense_spd.h"

#include <algorithm>
#include <utility>

namespace koebe {

SparseState::SparseState(const SparseMatrix& laplacian, const CondensedLaplacian& surface,
                         const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                         std::vector<VectorXd> first_angles)
    : GroundedState(loops, edges, std::move(first_angles)), loops_(loops), laplacian_(laplacian)
{
    std::vector<char> outer(laplacian.rows(), 0);
    for (const Index v : loops[0]) outer[v] = 1;
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index v = 0; v < static_cast<Index>(laplacian.cols()); ++v) {
        if (outer[v]) {
            entries.emplace_back(v, v, 1.0);
            continue;
        }
        for (SparseMatrix::InnerIterator it(laplacian, v); it; ++it)
            if (it.row() >= v && !outer[it.row()]) entries.emplace_back(static_cast<Index>(it.row()), v, it.value());
    }
    for (int k = 1; k < loop_count(); ++k)
        for (const Index v : loops[k])
            for (const Index w : loops[k])
                if (w >= v) entries.emplace_back(w, v, 0.0);
    empty_.resize(laplacian.rows(), laplacian.cols());
    empty_.setFromTriplets(entries.begin(), entries.end());
    filled_ = empty_;

    fill();
    if (begun()) return;
    int raised = 0;
    for (int k = 1; k < loop_count(); ++k) take_angles({k}, surface.flux_of_part(loops[k]), raised);
}

void SparseState::set_disk(int k, const MatrixXd& disk)
{
    stale_ = true;
    const VertexLoop& loop = loops_[k];
    for (Index c = 0; c < size_[k]; ++c) {
        const Index* rows = filled_.innerIndexPtr() + filled_.outerIndexPtr()[loop[c]];
        const Index* end = filled_.innerIndexPtr() + filled_.outerIndexPtr()[loop[c] + 1];
        for (Index r = 0; r < size_[k]; ++r) {
            if (loop[r] < loop[c]) continue;
            const std::ptrdiff_t at = std::lower_bound(rows, end, loop[r]) - filled_.innerIndexPtr();
            filled_.valuePtr()[at] = empty_.valuePtr()[at] + disk(r, c);
        }
    }
}

const SparseCholesky& SparseState::factor()
{
    if (std::exchange(stale_, false)) {
        if (factor_)
            factor_->refactorize(filled_);
        else
            factor_ = std::make_unique<SparseCholesky>(filled_, Ordering::amd, loops_[1]);
    }
    return *factor_;
}

std::vector<VectorXcd> SparseState::images()
{
    const VectorXcd outer = rim();
    MatrixXd z = MatrixXd::Zero(laplacian_.rows(), 2);
    for (Index b = 0; b < size_[0]; ++b) z.row(loops_[0][b]) << outer[b].real(), outer[b].imag();
    MatrixXd load = -(laplacian_ * z);
    load(loops_[0], Eigen::all) = z(loops_[0], Eigen::all);
    z = factor().solve(load);
    std::vector<VectorXcd> result{outer};
    for (int k = 1; k < loop_count(); ++k) {
        const MatrixXd image = z(loops_[k], Eigen::all);
        result.push_back(image.col(0) + Complex(0.0, 1.0) * image.col(1));
    }
    return result;
}

std::vector<VectorXd> SparseState::fluxes_against_outer()
{
    std::vector<VectorXd> result;
    for (MatrixXd& block : factor().inverse_blocks({loops_.begin() + 1, loops_.end()})) {
        const VectorXd ones = VectorXd::Ones(block.rows());
        result.push_back(spd_solve(std::move(block), ones));
    }
    return result;
}

VectorXd SparseState::outer_flux()
{
    return -VectorXd(laplacian_ * factor().extend(VectorXd::Ones(size_[1])))(loops_[0]);
}

}  // namespace koebe
