// The filled surface on its inner loops alone, the outer one held at 0: dense matrices.
#pragma once

#include "iteration/filled_state.h"
#include "linear/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// A = Sigma + sum T_k, the loops in falling order, so that the first inner one is last. One factor A = L L' gives the
/// images and the fluxes: with N = A^-1, N_kk = |L^-1 E_k|^2.
class DenseGroundedState final : public GroundedState {
public:
    /// The first angles are those of the flux through each inner loop with all others open and at one voltage.
    /// @param surface its boundary the concatenation of the loops, the outer one first, grounded or not; must outlive
    /// this
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive this
    /// @param first_angles the first angles instead, if there are any
    DenseGroundedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<VectorXd>& edges, std::vector<VectorXd> first_angles = {});

    std::vector<VectorXcd> images() override;

private:
    std::vector<VectorXd> fluxes_against_outer() override;
    VectorXd outer_flux() override;
    void set_disk(int k, const MatrixXd& disk) override;
    const MatrixXd& factor();

    const CondensedLaplacian& surface_;
    std::vector<Index> begin_;  // of each inner loop among the rows
    std::vector<Index> given_;  // for each row its number among the inner boundary vertices as given
    MatrixXd sigma_, filled_;   // Sigma and A
    MatrixXd coupling_;         // Sigma_R0, rows as given, unless the surface is grounded
    MatrixXd factor_;           // L, where it is not stale
    bool stale_ = true;
};

}  // namespace koebe
