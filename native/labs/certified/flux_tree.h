// Fluxes that enter at the loops and run along a tree of faces.
#pragma once

#include "certified/bisected_surface.h"
#include "core/types.h"
#include "surface/one_form.h"

#include <vector>

namespace koebe {

class FluxTree {
public:
    explicit FluxTree(const BisectedSurface& surface);

    /// The flux out of each face through its sides, for these fluxes out of the loops. They are multiples of one number
    /// with the sum 0, so that every sum here is exact, and each face's is 0.
    OneForm carry(const VectorXd& out_of_loop) const;

private:
    const BisectedSurface& surface_;
    std::vector<Index> gate_;          // a half-edge of each loop
    std::vector<Index> towards_root_;  // the half-edge of each face through which its flux goes on
    std::vector<Index> order_;         // faces, the root first
};

/// The fluxes out of the held loops in multiples of one power of two, with the sum 0.
/// @throws SolverError no flux runs
VectorXd rounded_fluxes(VectorXd flux, const std::vector<int>& held);

}  // namespace koebe
