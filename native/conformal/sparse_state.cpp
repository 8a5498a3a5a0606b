#include "conformal/sparse_state.h"

#include "core/parallel.h"
#include "geometry/dense_spd.h"

#include <algorithm>
#include <utility>

namespace koebe {

SparseState::SparseState(const SparseMatrix& laplacian, const CondensedLaplacian& surface,
                         const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges, VectorXd source)
    : FilledState(loops, edges), loops_(loops), source_(std::move(source))
{
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index v = 0; v < static_cast<Index>(laplacian.cols()); ++v)
        for (SparseMatrix::InnerIterator it(laplacian, v); it; ++it)
            if (it.row() >= v) entries.emplace_back(static_cast<Index>(it.row()), v, it.value());
    for (const VertexLoop& loop : loops)
        for (const Index v : loop)
            for (const Index w : loop)
                if (w >= v) entries.emplace_back(w, v, 0.0);
    empty_.resize(laplacian.rows(), laplacian.cols());
    empty_.setFromTriplets(entries.begin(), entries.end());
    filled_ = empty_;

    int raised = 0;
    for (int k = 0; k < loop_count(); ++k) take_angles({k}, surface.flux_of_part(loops[k]), raised);
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
            // Constants are in the kernel of A: the outer loop's mean is held at 0, which no flux without sum feels.
            if (k == 0) filled_.valuePtr()[at] += weights_[0][r] * weights_[0][c];
        }
    }
}

const SparseCholesky& SparseState::factor()
{
    if (std::exchange(stale_, false)) {
        if (factor_)
            factor_->refactorize(filled_);
        else
            factor_ = std::make_unique<SparseCholesky>(filled_, Ordering::amd, loops_[0]);
    }
    return *factor_;
}

MatrixXd SparseState::inverse_block(const std::vector<int>& loops)
{
    std::vector<SparseMatrix> units;
    for (const int k : loops) {
        SparseMatrix& unit = units.emplace_back(filled_.rows(), size_[k]);
        for (Index b = 0; b < size_[k]; ++b) {
            unit.startVec(b);
            unit.insertBack(loops_[k][b], b) = 1.0;
        }
        unit.finalize();
    }
    return factor().inverse_form(units);
}

std::vector<VectorXcd> SparseState::images()
{
    const VectorXcd outer = rim();
    MatrixXd parts(size_[0], 2);
    parts << outer.real(), outer.imag();
    const MatrixXd z = factor().extend(parts);
    std::vector<VectorXcd> result{outer};
    for (int k = 1; k < loop_count(); ++k) {
        const MatrixXd image = z(loops_[k], Eigen::all);
        result.push_back(image.col(0) + Complex(0.0, 1.0) * image.col(1));
    }
    return result;
}

std::vector<VectorXd> SparseState::fluxes(const std::vector<std::vector<int>>& open_sets)
{
    const bool sourced = open_sets[0].size() == 1;
    const VectorXd potential = sourced ? VectorXd(factor().solve(source_)) : VectorXd();
    factor();
    std::vector<VectorXd> result(open_sets.size());
    const int threads = DenseThreads::count();
    const DenseThreads one(1);  // the sets are shared out instead
    parallel_for(static_cast<int>(open_sets.size()), threads, [&](int i) {
        const std::vector<int>& open = open_sets[i];
        result[i] = flux_by_inverse(open, inverse_block(open),
                                    sourced ? VectorXd(potential(loops_[open[0]])) : VectorXd(), source_.sum());
    });
    return result;
}

}  // namespace koebe
