// Applies the verdict on the stored UVs to a map's report: whether it is finished, and the first warning.
#pragma once

#include "core/map_options.h"
#include "quality/report.h"

namespace koebe {

/// How to treat a map that loses too much of the surface's area.
struct LossPolicy {
    double most_lost = MapOptions{}.most_lost;  ///< share of the area; 1 allows any loss
    bool done = false;  ///< whether the map still counts as finished: the one map of a surface with long limbs
    const char* advice = "Parts (koebe parts) serve such surfaces";
};

/// If report.distortion loses more than allowed, puts a warning first, and the map has not converged unless
/// policy.done.
void take_verdict(const LossPolicy& policy, MapReport& report);

/// Moves a warning of lost area back to the first place, if others were put before it.
void put_loss_first(std::vector<Warning>& warnings);

}  // namespace koebe
