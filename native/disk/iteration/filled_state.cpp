#include "iteration/filled_state.h"

#include "circles/boundary_angles.h"
#include "core/numbering.h"
#include "execution/thread_share.h"
#include "iteration/disk_dirichlet_to_neumann.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double worth_sharing = 10000.0;  // entries; fewer take less time than the start of a thread

}  // namespace

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
    fill(numbers_below<int>(loop_count()));
}

void FilledState::fill(OpenedLoops loops)
{
    std::erase_if(loops, [&](int k) { return !fills(k); });
    std::vector<MatrixXd> disks(loops.size());
    const auto compute = [&](std::size_t i) { disks[i] = disk_of(loops[i]); };
    double entries = 0.0;
    for (const int k : loops) entries += std::pow(size_[k], 2);
    if (entries < worth_sharing)
        for (std::size_t i = 0; i < loops.size(); ++i) compute(i);
    else
        each_beside(loops.size(), compute);
    for (std::size_t i = 0; i < loops.size(); ++i) set_disk(loops[i], disks[i]);
}

MatrixXd FilledState::disk_of(int k) { return disk_dirichlet_to_neumann(angles_[k]); }

VectorXcd FilledState::rim() const { return unit_circle_points(angles_[0]); }

void FilledState::take_angles(const OpenedLoops& open, const VectorXd& flux, int& raised)
{
    std::vector<VectorXd> fluxes;
    Index row = 0;
    for (const int k : open) {
        fluxes.emplace_back(flux.segment(row, size_[k]));
        row += size_[k];
    }
    take_angles(open, fluxes, raised);
}

void FilledState::take_angles(const OpenedLoops& open, const std::vector<VectorXd>& fluxes, int& raised)
{
    for (std::size_t i = 0; i < open.size(); ++i) {
        const int k = open[i];
        angles_[k] = centered_angles(angles_from_flux(fluxes[i], edges_[k], raised), weights_[k], angles_[k]);
    }
    fill(open);
}

void FilledState::take_arc_lengths(const OpenedLoops& loops)
{
    for (const int k : loops) angles_[k] = centered_angles(arc_length_angles(edges_[k]), weights_[k]);
    fill(loops);
}

Index FilledState::total(const std::vector<int>& loops) const
{
    Index result = 0;
    for (const int k : loops) result += size_[k];
    return result;
}

OpenedLoops FilledState::inner_loops() const
{
    OpenedLoops result(size_.size() - 1);
    std::iota(result.begin(), result.end(), 1);
    return result;
}

void GroundedState::take_steps(const Sweep&, int& raised)
{
    take_angles(inner_loops(), fluxes_against_outer(), raised);
    take_angles({0}, outer_flux(), raised);
}

}  // namespace koebe
