#include "linear/filled_laplacian.h"

#include "core/errors.h"
#include "core/numbering.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double stiffness = 1e20;  // over the largest diagonal entry: its inverse vanishes beside rounding

constexpr std::size_t most_dense = 500;                 // vertices of a loop: its disk's factor takes about 0.1 s
constexpr Index fewest_nodes = 500, most_nodes = 1000;  // of a longer loop, at most
constexpr Index vertices_a_node = 25;                   // springs with more vertices cost more than a denser disk

/// Of the springs, over K's entries. A node is then off its mean by a millionth of its potential at most.
constexpr double spring = 1e6;

/// The lower triangle of K without the first loop, with an entry between any two vertices of each other loop.
SparseMatrix with_room_for_disks(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops)
{
    constexpr Index none = -1, first = 0;
    std::vector<Index> loop_of(laplacian.rows(), none);
    std::vector<std::vector<Index>> sorted = loops;
    std::ptrdiff_t entries = laplacian.nonZeros();
    for (std::size_t k = 0; k < loops.size(); ++k) {
        for (const Index v : loops[k]) loop_of[v] = static_cast<Index>(k);
        std::sort(sorted[k].begin(), sorted[k].end());
        if (k != first) entries += static_cast<std::ptrdiff_t>(loops[k].size() * loops[k].size());
    }
    // Merges each sorted column of K with the sorted rows of its loop.
    SparseMatrix result(laplacian.rows(), laplacian.cols());
    result.reserve(entries);
    for (Index v = 0; v < static_cast<Index>(laplacian.cols()); ++v) {
        result.startVec(v);
        if (loop_of[v] == first) {
            result.insertBack(v, v) = 1.0;
            continue;
        }
        auto room = sorted[first].end();
        const auto end = loop_of[v] == none ? room : sorted[loop_of[v]].end();
        if (loop_of[v] != none) room = std::lower_bound(sorted[loop_of[v]].begin(), end, v);
        for (SparseMatrix::InnerIterator it(laplacian, v); it; ++it) {
            const Index row = static_cast<Index>(it.row());
            if (row < v || loop_of[row] == first) continue;
            for (; room != end && *room < row; ++room) result.insertBack(*room, v) = 0.0;
            if (room != end && *room == row) ++room;
            result.insertBack(row, v) = it.value();
        }
        for (; room != end; ++room) result.insertBack(*room, v) = 0.0;
    }
    result.finalize();
    return result;
}

std::vector<Index> joined(const std::vector<std::vector<Index>>& loops)
{
    std::vector<Index> all;
    for (const std::vector<Index>& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
    return all;
}

}  // namespace

std::vector<std::vector<Index>> FilledLaplacian::nodes(Index loop_size)
{
    if (loop_size <= static_cast<Index>(most_dense)) return {};
    // Gaps of one length but for a run of longer ones: gaps that alternate would cost an order of accuracy.
    const Index most = std::clamp(loop_size / vertices_a_node, fewest_nodes, most_nodes);
    const Index gap = (loop_size + most - 1) / most, count = loop_size / gap, longer = loop_size % gap;
    const auto node = [&](Index c) { return c * gap + std::min(c, longer); };
    std::vector<std::vector<Index>> ties(static_cast<std::size_t>(count));
    for (Index c = 0; c < count; ++c)
        for (Index i = c > 0 ? node(c - 1) : node(count - 1) - loop_size; ++i < node(c + 1);)
            ties[static_cast<std::size_t>(c)].push_back(i < 0 ? i + loop_size : i);
    return ties;
}

FilledLaplacian::FilledLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops)
    : loops_(loops),
      boundary_(laplacian, joined(loops)),
      // Large disks get nodes of their own: unknowns past those of the surface.
      noded_([&] {
          std::vector<NodedLoop> noded;
          Index first = static_cast<Index>(laplacian.rows());
          for (std::size_t k = 1; k < loops.size(); ++k) {
              std::vector<std::vector<Index>> ties = nodes(static_cast<Index>(loops[k].size()));
              if (ties.empty()) continue;
              const Index count = static_cast<Index>(ties.size());
              noded.push_back({k, first, std::move(ties), GroundColumns(laplacian, loops[k])});
              first += count;
          }
          return noded;
      }()),
      surface_size_(static_cast<Index>(laplacian.rows())),
      factor_size_(surface_size_),
      // So stiff that a loop is held at 0.
      stiff_(stiffness * laplacian.diagonal().maxCoeff()),
      // One factorization with room for the blocks of all disks. Its last rows are those that change.
      cholesky_([&] {
          for (const NodedLoop& noded : noded_) factor_size_ += static_cast<Index>(noded.ties.size());
          const std::vector<std::vector<Index>> rows = disk_rows();
          const bool has_nodes = rows[1].front() >= surface_size_;
          return SparseCholesky(with_room_for_disks(with_nodes(laplacian), rows), rows[1], changing_rows(), has_nodes);
      }())
{
}

void FilledLaplacian::renew(const SparseMatrix& laplacian)
{
    boundary_.renew(laplacian);
    for (NodedLoop& noded : noded_) noded.columns.renew(laplacian);
    stiff_ = stiffness * laplacian.diagonal().maxCoeff();
    cholesky_.refactorize(with_room_for_disks(with_nodes(laplacian), disk_rows()));
    is_filled_ = true;
}

/// The rows of each loop's disk: its vertices, or its nodes.
std::vector<std::vector<Index>> FilledLaplacian::disk_rows() const
{
    std::vector<std::vector<Index>> rows = loops_;
    for (const NodedLoop& noded : noded_) {
        rows[noded.loop].resize(noded.ties.size());
        std::iota(rows[noded.loop].begin(), rows[noded.loop].end(), noded.first_node);
    }
    return rows;
}

/// The rows of each block: of the disks, and for loops with nodes of each spring and of each vertex.
std::vector<std::vector<Index>> FilledLaplacian::changing_rows() const
{
    std::vector<std::vector<Index>> rows = disk_rows();
    rows.erase(rows.begin());
    for (const NodedLoop& noded : noded_) {
        for (std::size_t c = 0; c < noded.ties.size(); ++c) {
            std::vector<Index>& spring_rows = rows.emplace_back();
            for (const Index place : noded.ties[c]) spring_rows.push_back(loops_[noded.loop][place]);
            spring_rows.push_back(noded.first_node + static_cast<Index>(c));
        }
        for (const Index v : loops_[noded.loop]) rows.push_back({v});
    }
    return rows;
}

/// K with rows for the nodes, and in its lower triangle an entry between any two rows of a spring.
SparseMatrix FilledLaplacian::with_nodes(const SparseMatrix& laplacian) const
{
    if (noded_.empty()) return laplacian;
    SparseMatrix wide = laplacian;
    wide.conservativeResize(factor_size_, factor_size_);
    std::vector<Eigen::Triplet<double, Index>> room;
    for (const NodedLoop& noded : noded_) {
        const std::vector<Index>& loop = loops_[noded.loop];
        const Index m = static_cast<Index>(loop.size()), n = static_cast<Index>(noded.ties.size());
        // Each pair of one spring's vertices once: all places ahead of a vertex that share a spring with it.
        for (Index i = 0; i < m; ++i)
            for (Index ahead = 0; ahead <= 2 * m / n && ahead < m; ++ahead) {
                const auto [low, high] = std::minmax(loop[i], loop[(i + ahead) % m]);
                room.emplace_back(high, low, 0.0);
            }
        for (Index c = 0; c < n; ++c) {
            const Index node = noded.first_node + c;
            room.emplace_back(node, node, 0.0);
            for (const Index place : noded.ties[static_cast<std::size_t>(c)]) room.emplace_back(node, loop[place], 0.0);
        }
    }
    SparseMatrix zeros(factor_size_, factor_size_);
    zeros.setFromTriplets(room.begin(), room.end());
    return wide + zeros;
}

/// The blocks of changing_rows(). @param held the number of a loop with nodes that is held at 0 without its disk; 0:
/// no loop is
std::vector<MatrixXd> FilledLaplacian::blocks(const std::vector<LoopDisk>& disks, int held) const
{
    std::vector<MatrixXd> result;
    for (const LoopDisk& disk : disks) result.push_back(disk.stiffness);
    for (const NodedLoop& noded : noded_) {
        const bool is_held = static_cast<int>(noded.loop) == held;
        for (const VectorXd& mean : disks[noded.loop - 1].means) {
            VectorXd row(mean.size() + 1);  // the spring's energy is (row u)^2
            row << -mean, 1.0;
            if (is_held) row.head(mean.size()).setZero();
            result.emplace_back(spring * row * row.transpose());
        }
        result.insert(result.end(), loops_[noded.loop].size(), MatrixXd::Constant(1, 1, is_held ? stiff_ : 0.0));
    }
    return result;
}

/// Blocks that hold all loops at 0.
std::vector<MatrixXd> FilledLaplacian::stiff_blocks() const
{
    std::vector<MatrixXd> result;
    const std::vector<std::vector<Index>> rows = changing_rows();
    for (const std::vector<Index>& block : rows)
        result.emplace_back(stiff_ * MatrixXd::Identity(block.size(), block.size()));
    return result;
}

const SparseCholesky& FilledLaplacian::fill(const std::vector<LoopDisk>& disks)
{
    is_filled_ = true;
    cholesky_.refactorize(blocks(disks, 0));
    return cholesky_;
}

std::pair<VectorXd, VectorXd> FilledLaplacian::raise(int k, const std::vector<LoopDisk>& disks,
                                                     const std::vector<Index>& wanted)
{
    is_filled_ = true;
    cholesky_.refactorize(blocks(disks, k));
    const auto noded = std::ranges::find(noded_, static_cast<std::size_t>(k), &NodedLoop::loop);
    const std::vector<Index>& loop = loops_[k];
    MatrixXd load = MatrixXd::Zero(factor_size_, 1);
    load.topRows(surface_size_) = noded->columns.load(MatrixXd::Ones(static_cast<Eigen::Index>(loop.size()), 1));
    load(loop, 0).setZero();
    load(loops_[0], 0).setZero();
    std::vector<Index> all = numbers_below(surface_size_);
    VectorXd u = cholesky_.solve_for(all, load).col(0);
    u(loop).setOnes();
    u(loops_[0]).setZero();
    return {u(wanted), -noded->columns.flux(u)};
}

/// Solves K_II u_I = f_I. Boundary entries are undefined. Returns NaN if K_II is not positive definite.
MatrixXd FilledLaplacian::solve_inside(MatrixXd load)
{
    const Eigen::Index rows = load.rows();
    load(boundary_.vertices(), Eigen::all).setZero();
    load.conservativeResize(factor_size_, Eigen::NoChange);
    load.bottomRows(factor_size_ - rows).setZero();
    try {
        if (is_filled_) cholesky_.refactorize(stiff_blocks());
    } catch (const OutOfMemory&) {
        throw;
    } catch (const SolverError&) {
        return MatrixXd::Constant(rows, load.cols(), std::numeric_limits<double>::quiet_NaN());
    }
    is_filled_ = false;
    std::vector<Index> all = numbers_below(rows);
    return cholesky_.solve_for(all, load);
}

MatrixXd FilledLaplacian::extend(const MatrixXd& boundary_values)
{
    MatrixXd result = solve_inside(boundary_.load(boundary_values));
    result(boundary_.vertices(), Eigen::all) = boundary_values;
    return result;
}

InteriorSolution FilledLaplacian::solve_interior(const VectorXd& load)
{
    VectorXd values = solve_inside(load);
    values(boundary_.vertices()).setZero();
    return {values, boundary_.flux(values)};
}

}  // namespace koebe
