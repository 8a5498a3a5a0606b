#include "iteration/sparse_state.h"

#include "execution/thread_share.h"
#include "iteration/disk_dirichlet_to_neumann.h"
#include "linear/dense_spd.h"

#include <utility>

namespace koebe {

SparseState::SparseState(const SparseMatrix& laplacian, FilledLaplacian& surface, const std::vector<VertexLoop>& loops,
                         const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles)
    : GroundedState(loops, edges, std::move(first_angles)),
      surface_(surface),
      inner_loops_(loops.begin() + 1, loops.end()),
      disks_(loops.size() - 1)
{
    for (const VertexLoop& loop : inner_loops_) {
        inner_.insert(inner_.end(), loop.begin(), loop.end());
        nodes_.push_back(FilledLaplacian::nodes(static_cast<Index>(loop.size())));
    }
    couple(laplacian, loops[0]);
    fill();
    if (!begun()) take_arc_lengths(inner_loops());
}

/// Takes the block of K between the outer loop and its neighbours.
void SparseState::couple(const SparseMatrix& laplacian, const VertexLoop& outer)
{
    std::vector<Index> row(laplacian.rows(), -1);
    for (const Index v : outer) row[v] = -2;
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (std::size_t c = 0; c < outer.size(); ++c)
        for (SparseMatrix::InnerIterator it(laplacian, outer[c]); it; ++it) {
            Index& place = row[it.row()];
            if (place == -2) continue;
            if (place == -1) {
                place = static_cast<Index>(beside_outer_.size());
                beside_outer_.push_back(static_cast<Index>(it.row()));
            }
            entries.emplace_back(place, static_cast<Index>(c), it.value());
        }
    coupling_.resize(beside_outer_.size(), outer.size());
    coupling_.setFromTriplets(entries.begin(), entries.end());
}

MatrixXd SparseState::disk_of(int k)
{
    if (!has_nodes(k)) return GroundedState::disk_of(k);
    CoarseDisk coarse = coarse_disk(angles_[k], nodes_[k - 1]);
    disks_[k - 1].means = std::move(coarse.means);
    return std::move(coarse.stiffness);
}

void SparseState::set_disk(int k, const MatrixXd& disk)
{
    disks_[k - 1].stiffness = disk;
    factor_ = nullptr;
}

const SparseCholesky& SparseState::factor()
{
    if (factor_ == nullptr) factor_ = &surface_.fill(disks_);
    return *factor_;
}

/// Solves A z = -K z_0 on the inner loops, z_0 on the outer loop alone.
std::vector<VectorXcd> SparseState::images()
{
    const VectorXcd outer = rim();
    MatrixXd parts(size_[0], 2);
    parts << outer.real(), outer.imag();
    MatrixXd load = MatrixXd::Zero(surface_.factor_size(), 2);
    load(beside_outer_, Eigen::all) = -(coupling_ * parts);
    const MatrixXd z = factor().solve_for(inner_, load);
    std::vector<VectorXcd> result{outer};
    Index row = 0;
    for (int k = 1; k < loop_count(); ++k) {
        const auto rows = z.middleRows(row, size_[k]);
        result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
        row += size_[k];
    }
    return result;
}

std::vector<VectorXd> SparseState::fluxes_against_outer()
{
    std::vector<VectorXd> result(inner_loops_.size());
    std::vector<std::vector<Index>> dense;
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < inner_loops_.size(); ++k)
        if (nodes_[k].empty()) {
            dense.push_back(inner_loops_[k]);
            numbers.push_back(k);
        }
    if (!dense.empty()) {
        std::vector<MatrixXd> blocks = factor().inverse_blocks(dense);
        each_beside(blocks.size(), [&](std::size_t i) {
            const VectorXd ones = VectorXd::Ones(static_cast<Eigen::Index>(dense[i].size()));
            result[numbers[i]] = spd_solve(std::move(blocks[i]), ones);
        });
    }
    for (std::size_t k = 0; k < inner_loops_.size(); ++k) {
        if (nodes_[k].empty()) continue;
        result[k] = surface_.raise(static_cast<int>(k) + 1, disks_, {}).second;
        factor_ = nullptr;
    }
    return result;
}

VectorXd SparseState::outer_flux()
{
    VectorXd beside;
    if (has_nodes(1)) {
        beside = surface_.raise(1, disks_, beside_outer_).first;
        factor_ = nullptr;
    } else {
        beside = factor().extend_to(beside_outer_, VectorXd::Ones(size_[1]));
    }
    return -(coupling_.transpose() * beside);
}

}  // namespace koebe
