// The filled surface on its boundary alone, as dense matrices, for up to a few thousand boundary vertices.
#pragma once

#include "iteration/filled_state.h"
#include "linear/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// A = Sigma + sum T_k over all loops. The step on a few open loops P eliminates the rest R, f_R = -A_RR^-1 A_RP f_P.
class CondensedState final : public FilledState {
public:
    /// The first angles of a loop come from the flux through it, Sigma_kk 1, with all other loops open and at one
    /// voltage.
    /// @param surface its boundary is the concatenation of the loops, nothing grounded
    /// @param loops the outer loop first
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive the state
    /// @param first_angles the first angles instead, if not empty
    /// @param source (m) flux that arrives at each boundary vertex from a source inside, for one open loop
    CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<VectorXd>& edges, VectorXd source, std::vector<VectorXd> first_angles = {});

    std::vector<VectorXcd> images() override;
    bool opens_at_once() const override { return false; }
    void take_steps(const Sweep& together, int& raised) override;

private:
    /// The flux through open loops, one after the other. It is the flux of the harmonic function that is 0 on the first
    /// and 1 on the second; with one open loop, held at 0, it is the source's flux.
    VectorXd flux(const OpenedLoops& open) const;
    void set_disk(int k, const MatrixXd& disk) override;
    MatrixXd gather(const MatrixXd& matrix, const std::vector<int>& rows, const std::vector<int>& columns) const;
    VectorXd gather(const VectorXd& vector, const std::vector<int>& rows) const;
    auto diagonal_block(const MatrixXd& matrix, int k) const
    {
        return matrix.block(begin_[k], begin_[k], size_[k], size_[k]);
    }

    std::vector<Index> begin_;  // first row of each loop
    VectorXd source_;
    MatrixXd sigma_, filled_;  // Sigma and A
};

}  // namespace koebe
