// The filled surface on its boundary alone: dense matrices, for boundaries of up to a few thousand vertices.
#pragma once

#include "iteration/filled_state.h"
#include "linear/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// A = Sigma + sum T_k over all loops. A few open loops are solved by elimination of the rest R, f_R = -A_RR^-1 A_RP
/// f_P.
class CondensedState final : public FilledState {
public:
    /// The first angles are those of the flux through each loop with all others open and at one voltage, Sigma_kk 1.
    /// @param surface its boundary the concatenation of the loops, nothing grounded
    /// @param loops the outer loop first
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive this
    /// @param first_angles these angles instead, if there are any
    /// @param source (m) flux that arrives at each boundary vertex from a source inside, for one open loop
    CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<VectorXd>& edges, VectorXd source, std::vector<VectorXd> first_angles = {});

    std::vector<VectorXcd> images() override;
    bool opens_at_once() const override { return false; }
    void take_steps(const Sweep& together, int& raised) override;

private:
    /// The flux through open loops, one after the other: of the harmonic function that is 0 on the first and 1 on the
    /// second, or of the source with one open loop at 0.
    VectorXd flux(const OpenedLoops& open) const;
    void set_disk(int k, const MatrixXd& disk) override;
    MatrixXd gather(const MatrixXd& matrix, const std::vector<int>& rows, const std::vector<int>& columns) const;
    VectorXd gather(const VectorXd& vector, const std::vector<int>& rows) const;
    auto diagonal_block(const MatrixXd& matrix, int k) const
    {
        return matrix.block(begin_[k], begin_[k], size_[k], size_[k]);
    }

    std::vector<Index> begin_;  // of each loop among the rows
    VectorXd source_;
    MatrixXd sigma_, filled_;  // Sigma and A
};

}  // namespace koebe
