// The filled surface as one sparse matrix: for boundaries too long for dense matrices of all their vertices.
#pragma once

#include "conformal/filled_state.h"
#include "geometry/condensed_laplacian.h"
#include "geometry/sparse_cholesky.h"

#include <memory>
#include <vector>

namespace koebe {

/// A = K + sum T_k over all vertices, the disks as small dense blocks: one symbolic analysis for all sweeps, a numeric
/// factorization for each, and from it the blocks M_PP of M = A^-1 that the open loops P see.
class SparseState final : public FilledState {
public:
    /// The first angles are those of the flux through each loop with all others open and at one voltage.
    /// @param laplacian (V, V) both triangles stored @param surface of the same Laplacian
    /// @param source (V) what a source inside feeds into each vertex, for steps with one open loop
    SparseState(const SparseMatrix& laplacian, const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                const std::vector<VectorXd>& edges, VectorXd source);

    std::vector<VectorXcd> images() override;
    std::vector<VectorXd> fluxes(const std::vector<std::vector<int>>& open_sets) override;

private:
    void set_disk(int k, const MatrixXd& disk) override;
    const SparseCholesky& factor();
    MatrixXd inverse_block(const std::vector<int>& loops);

    const std::vector<VertexLoop>& loops_;
    VectorXd source_;
    SparseMatrix empty_, filled_;  // K and A, lower triangles of one pattern
    std::unique_ptr<SparseCholesky> factor_;
    bool stale_ = true;            // the factor is of other disks
};

}  // namespace koebe
