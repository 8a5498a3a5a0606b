#include "iteration/sparse_state.h"

#include "execution/thread_share.h"
#include "linear/dense_spd.h"

#include <utility>

namespace koebe {

SparseState::SparseState(const SparseMatrix& laplacian, FilledLaplacian& surface, const std::vector<VertexLoop>& loops,
                         const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles)
    : GroundedState(loops, edges, std::move(first_angles)),
      vertex_count_(static_cast<Index>(laplacian.rows())),
      surface_(surface),
      inner_loops_(loops.begin() + 1, loops.end()),
      disks_(loops.size() - 1)
{
    for (const VertexLoop& loop : inner_loops_) inner_.insert(inner_.end(), loop.begin(), loop.end());
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

void SparseState::set_disk(int k, const MatrixXd& disk)
{
    disks_[k - 1] = disk;
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
    MatrixXd load = MatrixXd::Zero(vertex_count_, 2);
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
    std::vector<MatrixXd> blocks = factor().inverse_blocks(inner_loops_);
    std::vector<VectorXd> result(blocks.size());
    each_beside(blocks.size(), [&](std::size_t k) {
        result[k] = spd_solve(std::move(blocks[k]), VectorXd::Ones(static_cast<Eigen::Index>(inner_loops_[k].size())));
    });
    return result;
}

VectorXd SparseState::outer_flux()
{
    return -(coupling_.transpose() * factor().extend_to(beside_outer_, VectorXd::Ones(size_[1])));
}

}  // namespace koebe
