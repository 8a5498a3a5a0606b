// The filled surface on its inner loops, the outer one held at 0, as dense matrices.
#pragma once

#include "iteration/filled_state.h"
#include "linear/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// A = Sigma + sum T_k with the loops in reverse order, so that the first inner loop is last. One factor A = L L' gives
/// the images and the fluxes: with N = A^-1, N_kk = Z_k^T Z_k, Z_k the columns of loop k in L^-1 (docs/method.md, M9).
class DenseGroundedState final : public GroundedState {
public:
    /// The first angles of an inner loop come from the flux through it with all other loops open and at one voltage.
    /// @param surface its boundary is the concatenation of the loops, the outer one first, grounded or not; must
    /// outlive the state
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive the state
    /// @param first_angles the first angles instead, if not empty
    DenseGroundedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles = {});

    std::vector<VectorXcd> images() override;

private:
    std::vector<VectorXd> fluxes_against_outer() override;
    VectorXd outer_flux() override;
    void set_disk(int k, const MatrixXd& disk) override;
    const MatrixXd& factor();

    const CondensedLaplacian& surface_;
    std::vector<Index> begin_;  // first row of each inner loop
    std::vector<Index> given_;  // for each row the given number among the inner boundary vertices
    MatrixXd sigma_, filled_;   // Sigma and A
    MatrixXd coupling_;         // Sigma_R0, rows in the given order, unless the surface is grounded
    MatrixXd factor_;           // L, unless it is stale
    bool stale_ = true;
};

}  // namespace koebe
