// What the verdict on the stored UVs means for a map: whether it is done, and what is said first.
#pragma once

#include "core/map_options.h"
#include "quality/report.h"

namespace koebe {

/// What becomes of a map that loses too much of the surface's area.
struct LossPolicy {
    double most_lost = MapOptions{}.most_lost;  ///< share of the area; 1: any loss is taken
    bool done = false;  ///< whether it is done all the same: the one map of a surface with long limbs
    const char* advice = "Parts (koebe parts) serve such surfaces";
};

/// If report.distortion loses more than the policy has it, a warning that says so comes first, and the map has not
/// converged unless it is done all the same.
void take_verdict(const LossPolicy& policy, MapReport& report);

/// Puts a warning of lost area back to the first place, where others were put before it.
void put_loss_first(std::vector<Warning>& warnings);

}  // namespace koebe
