#include "conformal/filled_state.h"

#include "conformal/boundary_angles.h"
#include "conformal/disk_dirichlet_to_neumann.h"
#include "geometry/dense_spd.h"

namespace koebe {

FilledState::FilledState(const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges)
    : edges_(edges), angles_(loops.size())
{
    for (std::size_t k = 0; k < loops.size(); ++k) {
        size_.push_back(static_cast<Index>(loops[k].size()));
        weights_.push_back(vertex_weights(edges[k]));
    }
}

VectorXcd FilledState::rim() const { return unit_circle_points(angles_[0]); }

void FilledState::take_angles(const std::vector<int>& open, const VectorXd& flux, int& raised)
{
    Index row = 0;
    for (const int k : open) {
        angles_[k] = centered_angles(angles_from_flux(flux.segment(row, size_[k]), edges_[k], raised), weights_[k],
                                     angles_[k]);
        set_disk(k, disk_dirichlet_to_neumann(angles_[k]));
        row += size_[k];
    }
}

/// M_PP q is the function on P up to a constant, which is such that no net flux runs: such a flux has the potential M q
/// up to a constant, however the constants are held.
VectorXd FilledState::flux_by_inverse(const std::vector<int>& open, const MatrixXd& inverse_block,
                                      const VectorXd& source_potential, double source_sum) const
{
    MatrixXd values = MatrixXd::Ones(total(open), 2);
    if (open.size() == 1)
        values.col(0) = source_potential;
    else
        values.col(0).head(size_[open[0]]).setZero();
    const double net = open.size() == 1 ? source_sum : 0.0;
    const MatrixXd fluxes = spd_solve(inverse_block, values);
    return fluxes.col(0) - (fluxes.col(0).sum() - net) / fluxes.col(1).sum() * fluxes.col(1);
}

Index FilledState::total(const std::vector<int>& loops) const
{
    Index result = 0;
    for (const int k : loops) result += size_[k];
    return result;
}

}  // namespace koebe
