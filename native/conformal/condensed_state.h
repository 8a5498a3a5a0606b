// The state of the condensed Koebe iteration: a surface with a round disk in every hole.
#pragma once

#include "core/types.h"
#include "geometry/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// Sigma, one angle per boundary vertex, and A = Sigma + sum T_k for them (docs/method.md, "The condensed engine").
/// Loops are opened by removing their disk T_k; the rest R of the boundary stays filled.
class CondensedState {
public:
    /// The first angles are those of the flux through each loop with all others open and at one voltage, Sigma_kk 1;
    /// with one loop alone, of the flux from the source.
    /// @param surface its boundary the concatenation of the loops
    /// @param loops the outer loop first
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive this
    /// @param source (m) flux that arrives at each boundary vertex from a source inside, for one open loop
    CondensedState(const CondensedLaplacian& surface, const std::vector<VertexLoop>& loops,
                  const std::vector<VectorXd>& edges, VectorXd source);

    int loop_count() const { return static_cast<int>(size_.size()); }

    /// The outer loop on the unit circle, at its angles.
    VectorXcd rim() const;

    /// The map of the surface with all loops but the outer one filled and the outer one on the unit circle, on every
    /// loop: harmonic, A_RR z_R = -A_R0 exp(i theta_0).
    std::vector<VectorXcd> images() const;

    /// For each set of open loops the flux through them, one loop after the other: of the harmonic function that is 0
    /// on the first and 1 on the second, or of the source with one open loop at 0. All from the present state; a
    /// single set by elimination, f_R = -A_RR^-1 A_RP f_P, many by one inverse for all.
    std::vector<VectorXd> fluxes(const std::vector<std::vector<int>>& open_sets) const;

    /// New angles for open loops from the flux through them: the conjugate of the harmonic function.
    /// @param raised incremented by the number of steps along a loop that had to be raised
    void take_angles(const std::vector<int>& open, const VectorXd& flux, int& raised);

private:
    VectorXd eliminated_flux(const std::vector<int>& open) const;
    VectorXd flux_by_inverse(const std::vector<int>& open, const MatrixXd& inverse) const;
    MatrixXd gather(const MatrixXd& matrix, const std::vector<int>& rows, const std::vector<int>& columns) const;
    VectorXd gather(const VectorXd& vector, const std::vector<int>& rows) const;
    Index total(const std::vector<int>& loops) const;
    auto diagonal_block(const MatrixXd& matrix, int k) const
    {
        return matrix.block(begin_[k], begin_[k], size_[k], size_[k]);
    }

    const std::vector<VectorXd>& edges_;
    VectorXd source_;
    MatrixXd sigma_, filled_;  // Sigma and A
    std::vector<Index> begin_, size_;
    std::vector<VectorXd> weights_, angles_;
};

}  // namespace koebe
