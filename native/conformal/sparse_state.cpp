#include "conformal/sparse_state.h"

#include "conformal/boundary_angles.h"
#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr Eigen::Index batch = 64;          // right-hand sides at once
constexpr int most_steps = 200;
constexpr double diagonal_part = 1e-3;
constexpr double residual_limit = 1e-11;    // of the first residual, in the preconditioner's norm

}  // namespace

SparseState::SparseState(const SparseMatrix& laplacian, const CondensedLaplacian& surface,
                         const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges, VectorXd source)
    : FilledState(loops, edges), loops_(loops), source_(std::move(source)), disks_(loops.size())
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
    for (int first = 0; first < loop_count(); first += batch) {
        const Eigen::Index count = std::min<Eigen::Index>(batch, loop_count() - first);
        MatrixXd indicators = MatrixXd::Zero(surface.boundary_size(), count);
        for (Eigen::Index i = 0; i < count; ++i)
            indicators.block(begin_[first + i], i, size_[first + i], 1).setOnes();
        const MatrixXd flux = laplacian * surface.extend(indicators);
        for (Eigen::Index i = 0; i < count; ++i) {
            const int k = first + static_cast<int>(i);
            take_angles({k}, gather(flux.col(i), {k}), raised);
        }
    }
}

void SparseState::set_disk(int k, const MatrixXd& disk)
{
    disks_[k] = disk;
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

VectorXd SparseState::gather(const VectorXd& vertices, const std::vector<int>& loops) const
{
    VectorXd result(total(loops));
    Index row = 0;
    for (const int k : loops)
        for (const Index v : loops_[k]) result[row++] = vertices[v];
    return result;
}

std::vector<VectorXcd> SparseState::images()
{
    const VectorXcd outer = rim();
    const VectorXd none = VectorXd::Zero(size_[0]);
    const std::vector<Problem> problems{{{0}, outer.real(), none}, {{0}, outer.imag(), none}};
    const MatrixXd parts = potentials(problems, solve(problems, images_), false);
    // Up to a constant, which the outer loop knows.
    const VectorXcd z = parts.col(0) + Complex(0.0, 1.0) * parts.col(1);
    Complex shift(0.0, 0.0);
    for (Index b = 0; b < size_[0]; ++b) shift += (outer[b] - z[loops_[0][b]]) / static_cast<double>(size_[0]);
    std::vector<VectorXcd> result{outer};
    for (int k = 1; k < loop_count(); ++k) {
        VectorXcd image(size_[k]);
        for (Index b = 0; b < size_[k]; ++b) image[b] = z[loops_[k][b]] + shift;
        result.push_back(std::move(image));
    }
    return result;
}

std::vector<VectorXd> SparseState::fluxes(const std::vector<std::vector<int>>& open_sets)
{
    std::vector<Problem> problems;
    for (const std::vector<int>& open : open_sets) {
        Problem problem{open, VectorXd::Zero(total(open)), VectorXd::Zero(total(open)), open.size() == 1};
        if (problem.sourced) {
            problem.start = -source_.sum() * weights_[open[0]];
        } else {
            problem.values.tail(size_[open[1]]).setOnes();
            problem.start << -weights_[open[0]], weights_[open[1]];
        }
        problems.push_back(std::move(problem));
    }
    return solve(problems, fluxes_);
}

/// The potential at all vertices of currents fed into the open loops, and by the source.
MatrixXd SparseState::potentials(const std::vector<Problem>& problems, const std::vector<VectorXd>& currents,
                                 bool sourced)
{
    if (std::exchange(stale_, false)) {
        if (factor_)
            factor_->refactorize(filled_);
        else
            factor_ = std::make_unique<SparseCholesky>(filled_);
    }
    MatrixXd load = MatrixXd::Zero(filled_.rows(), static_cast<Eigen::Index>(problems.size()));
    for (std::size_t p = 0; p < problems.size(); ++p) {
        if (sourced && problems[p].sourced) load.col(p) = source_;
        Index row = 0;
        for (const int k : problems[p].open)
            for (const Index v : loops_[k]) load(v, p) += currents[p][row++];
    }
    return factor_->solve(load);
}

/// T_P, and between two loops the current that a unit of voltage draws through a conductance of 1; without net current,
/// whatever constant the residual has. A part of the diagonal keeps it definite where angles nearly coincide.
VectorXd SparseState::preconditioned(const Problem& problem, const VectorXd& residual) const
{
    VectorXd share(residual.size()), difference(residual.size()), result(residual.size());
    Index row = 0;
    for (const int k : problem.open) {
        share.segment(row, size_[k]) = weights_[k] / static_cast<double>(problem.open.size());
        difference.segment(row, size_[k]) = (row == 0 ? -1.0 : 1.0) * weights_[k];
        row += size_[k];
    }
    const VectorXd voltage = residual.array() - share.dot(residual);
    row = 0;
    for (const int k : problem.open) {
        const auto part = voltage.segment(row, size_[k]);
        result.segment(row, size_[k]) =
            disks_[k] * part + diagonal_part * disks_[k].diagonal().cwiseProduct(part);
        row += size_[k];
    }
    if (problem.open.size() == 2) result += difference.dot(voltage) * difference;
    return result - result.sum() * share;
}

std::vector<VectorXd> SparseState::solve(const std::vector<Problem>& problems, Earlier& earlier)
{
    const bool cold = earlier.flux.empty();
    if (cold) earlier.size.resize(problems.size());
    std::vector<VectorXd> result;
    for (std::size_t first = 0; first < problems.size(); first += batch) {
        const std::vector<Problem> some(problems.begin() + first,
                                        problems.begin() + std::min(problems.size(), first + batch));
        const std::size_t count = some.size();
        std::vector<VectorXd> flux(count), residual(count), direction(count);
        std::vector<double> size(count);
        for (std::size_t p = 0; p < count; ++p) flux[p] = cold ? some[p].start : earlier.flux[first + p];
        const MatrixXd begin = potentials(some, flux, true);
        for (std::size_t p = 0; p < count; ++p) {
            residual[p] = some[p].values - gather(begin.col(p), some[p].open);
            direction[p] = preconditioned(some[p], residual[p]);
            size[p] = residual[p].dot(direction[p]);
            if (cold) earlier.size[first + p] = size[p];
        }
        const auto unfinished = [&](std::size_t p) {
            return size[p] > residual_limit * residual_limit * earlier.size[first + p];
        };
        for (int step = 0;; ++step) {
            std::vector<std::size_t> active;
            for (std::size_t p = 0; p < count; ++p)
                if (unfinished(p)) active.push_back(p);
            if (active.empty()) break;
            if (step == most_steps)
                throw SolverError("the filled surface's potentials do not converge: its boundary is torn in all but "
                                  "topology");
            std::vector<Problem> opened;
            std::vector<VectorXd> currents;
            for (const std::size_t p : active) {
                opened.push_back(some[p]);
                currents.push_back(direction[p]);
            }
            const MatrixXd response = potentials(opened, currents, false);
            for (std::size_t a = 0; a < active.size(); ++a) {
                const std::size_t p = active[a];
                const VectorXd raised = gather(response.col(a), some[p].open);
                const double length = size[p] / direction[p].dot(raised);
                flux[p] += length * direction[p];
                residual[p] -= length * raised;
                const VectorXd next = preconditioned(some[p], residual[p]);
                const double next_size = residual[p].dot(next);
                direction[p] = next + next_size / size[p] * direction[p];
                size[p] = next_size;
            }
        }
        for (VectorXd& one : flux) result.push_back(std::move(one));
    }
    earlier.flux = result;
    return result;
}

}  // namespace koebe
