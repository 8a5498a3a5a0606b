// The filled surface as one sparse matrix: for boundaries too long for dense matrices of all their vertices.
#pragma once

#include "iteration/filled_state.h"
#include "linear/condensed_laplacian.h"
#include "linear/sparse_cholesky.h"

#include <memory>
#include <vector>

namespace koebe {

/// A = K + sum T_k over all vertices but those of the outer loop, the disks as small dense blocks: one symbolic
/// analysis for all sweeps, a numeric factorization for each, and from it the images and the blocks N_kk of N = A^-1.
class SparseState final : public GroundedState {
public:
    /// The first angles are those of the flux through each loop with all others open and at one voltage.
    /// @param surface of the same Laplacian
    /// @param laplacian (V, V) both triangles stored; must outlive this
    SparseState(const SparseMatrix& laplacian, const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles = {});

    std::vector<VectorXcd> images() override;

private:
    std::vector<VectorXd> fluxes_against_outer() override;
    VectorXd outer_flux() override;
    void set_disk(int k, const MatrixXd& disk) override;
    const SparseCholesky& factor();

    const std::vector<VertexLoop>& loops_;
    const SparseMatrix& laplacian_;
    SparseMatrix empty_, filled_;  // K and A, lower triangles of one pattern, 1 for the vertices of the outer loop
    std::unique_ptr<SparseCholesky> factor_;
    bool stale_ = true;  // the factor is of other disks
};

}  // namespace koebe
