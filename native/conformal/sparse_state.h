// The filled surface as one sparse matrix: for boundaries too long for dense matrices of all their vertices.
#pragma once

#include "conformal/filled_state.h"
#include "geometry/condensed_laplacian.h"
#include "geometry/sparse_cholesky.h"

#include <memory>
#include <vector>

namespace koebe {

/// A = K + sum T_k over all vertices, the disks as small dense blocks; its factor gives M = A^-1. The flux q through
/// open loops P solves M_PP q = f_P up to a constant, all sets together, by conjugate gradients: T_P, which is about
/// half of (M_PP)^-1, is the preconditioner, and a step costs one back-substitution for each set.
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
    struct Problem {
        std::vector<int> open;
        VectorXd values, start;  // on the open loops: potentials wanted, and a flux with the right sum
        bool sourced = false;
    };
    void set_disk(int k, const MatrixXd& disk) override;
    /// What the same problems had in the sweep before.
    struct Earlier {
        std::vector<VectorXd> flux;
        std::vector<double> size;  // of the first residual of all
    };
    std::vector<VectorXd> solve(const std::vector<Problem>& problems, Earlier& earlier);
    MatrixXd potentials(const std::vector<Problem>& problems, const std::vector<VectorXd>& currents, bool sourced);
    VectorXd preconditioned(const Problem& problem, const VectorXd& residual) const;
    VectorXd gather(const VectorXd& vertices, const std::vector<int>& loops) const;

    const std::vector<VertexLoop>& loops_;
    VectorXd source_;
    SparseMatrix empty_, filled_;  // K and A, lower triangles of one pattern
    std::vector<MatrixXd> disks_;
    std::unique_ptr<SparseCholesky> factor_;
    bool stale_ = true;            // the factor is of other disks
    Earlier fluxes_, images_;
};

}  // namespace koebe
