#include "iteration/filled_state.h"

#include "circles/boundary_angles.h"
#include "iteration/disk_dirichlet_to_neumann.h"

#include <utility>

namespace koebe {

FilledState::FilledState(const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                         std::vector<VectorXd> first_angles)
    : edges_(edges), angles_(std::move(first_angles)), begun_(!angles_.empty())
{
    angles_.resize(loops.size());
    for (std::size_t k = 0; k < loops.size(); ++k) {
        size_.push_back(static_cast<Index>(loops[k].size()));
        weights_.push_back(vertex_weights(edges[k]));
    }
}

void FilledState::fill()
{
    if (!begun()) return;
    for (int k = 0; k < loop_count(); ++k)
        if (fills(k)) set_disk(k, disk_dirichlet_to_neumann(angles_[k]));
}

VectorXcd FilledState::rim() const { return unit_circle_points(angles_[0]); }

void FilledState::take_angles(const OpenedLoops& open, const VectorXd& flux, int& raised)
{
    Index row = 0;
    for (const int k : open) {
        angles_[k] =
            centered_angles(angles_from_flux(flux.segment(row, size_[k]), edges_[k], raised), weights_[k], angles_[k]);
        if (fills(k)) set_disk(k, disk_dirichlet_to_neumann(angles_[k]));
        row += size_[k];
    }
}

void FilledState::take_arc_length(int k)
{
    angles_[k] = centered_angles(arc_length_angles(edges_[k]), weights_[k]);
    set_disk(k, disk_dirichlet_to_neumann(angles_[k]));
}

Index FilledState::total(const std::vector<int>& loops) const
{
    Index result = 0;
    for (const int k : loops) result += size_[k];
    return result;
}

void GroundedState::take_steps(const Sweep&, int& raised)
{
    const std::vector<VectorXd> fluxes = fluxes_against_outer();
    for (int k = 1; k < loop_count(); ++k) take_angles({k}, fluxes[k - 1], raised);
    take_angles({0}, outer_flux(), raised);
}

}  // namespace koebe
