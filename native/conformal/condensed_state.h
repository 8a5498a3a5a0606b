// The filled surface on its boundary alone: dense matrices, for boundaries of up to a few thousand vertices.
#pragma once

#include "conformal/filled_state.h"
#include "geometry/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// A = Sigma + sum T_k, the outer loop last. One set of open loops is solved by elimination of the rest R,
/// f_R = -A_RR^-1 A_RP f_P. Many are solved from one factor L of A with the constants held: its leading part, that of
/// the inner loops, gives the images, L^-1 the blocks M_PP = |L^-1 E_P|^2 of the inverse M.
class CondensedState final : public FilledState {
public:
    /// The first angles are those of the flux through each loop with all others open and at one voltage, Sigma_kk 1.
    /// @param surface its boundary the concatenation of the loops
    /// @param loops the outer loop first
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive this
    /// @param source (m) flux that arrives at each boundary vertex from a source inside, for one open loop
    CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                  const std::vector<VectorXd>& edges, VectorXd source);

    std::vector<VectorXcd> images() override;
    std::vector<VectorXd> fluxes(const std::vector<std::vector<int>>& open_sets) override;

private:
    void set_disk(int k, const MatrixXd& disk) override;
    VectorXd eliminated_flux(const std::vector<int>& open) const;
    MatrixXd gather(const MatrixXd& matrix, const std::vector<int>& rows, const std::vector<int>& columns) const;
    VectorXd gather(const VectorXd& vector, const std::vector<int>& rows) const;
    MatrixXd inverse_block(const std::vector<int>& open, const MatrixXd& inverse_lower) const;
    const MatrixXd& inner_factor();
    auto diagonal_block(const MatrixXd& matrix, int k) const
    {
        return matrix.block(begin_[k], begin_[k], size_[k], size_[k]);
    }

    std::vector<Index> begin_;         // of each loop among the rows
    VectorXd source_;
    MatrixXd sigma_, filled_;          // Sigma and A
    MatrixXd inner_factor_;            // of A on the inner loops, where it is not stale
    bool stale_ = true;
};

}  // namespace koebe
