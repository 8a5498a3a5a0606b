// The filled surface as one sparse matrix, for boundaries too long for dense matrices.
#pragma once

#include "iteration/filled_state.h"
#include "linear/filled_laplacian.h"
#include "linear/sparse_cholesky.h"

#include <vector>

namespace koebe {

/// A = K + sum T_k over all vertices but the outer loop's, with the disks as small dense blocks. A sweep recomputes
/// only the part of the factor that the disks reach. The factor gives the images and the blocks N_kk of N = A^-1. Loops
/// with many vertices have their disks on nodes (LoopDisk); the flux through each comes from a factor with it held.
class SparseState final : public GroundedState {
public:
    /// The first angles come from one sweep that starts at arc lengths.
    /// @param first_angles the first angles instead, if not empty
    /// @param surface of the same Laplacian and these loops; must outlive the state
    /// @param laplacian (V, V) both triangles stored
    SparseState(const SparseMatrix& laplacian, FilledLaplacian& surface, const std::vector<VertexLoop>& loops,
                const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles = {});

    std::vector<VectorXcd> images() override;
    void start(int& raised) override
    {
        if (!begun()) take_steps({}, raised);
    }

private:
    std::vector<VectorXd> fluxes_against_outer() override;
    VectorXd outer_flux() override;
    MatrixXd disk_of(int k) override;
    void set_disk(int k, const MatrixXd& disk) override;
    const SparseCholesky& factor();
    bool has_nodes(int k) const { return !nodes_[k - 1].empty(); }

    void couple(const SparseMatrix& laplacian, const VertexLoop& outer);

    FilledLaplacian& surface_;
    std::vector<VertexLoop> inner_loops_;
    std::vector<Index> inner_;                            // all vertices of the inner loops
    std::vector<Index> beside_outer_;                     // the outer loop's neighbours
    SparseMatrix coupling_;                               // K, (neighbours, outer loop)
    std::vector<std::vector<std::vector<Index>>> nodes_;  // per inner loop (FilledLaplacian::nodes)
    std::vector<LoopDisk> disks_;                         // of the inner loops
    const SparseCholesky* factor_ = nullptr;              // of A; nullptr after a change of the disks
};

}  // namespace koebe
