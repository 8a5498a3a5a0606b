#include "quality/take_verdict.h"

#include "core/counted.h"

#include <algorithm>

namespace koebe {

void take_verdict(const LossPolicy& policy, MapReport& report)
{
    const Distortion& distortion = report.distortion;
    if (!(distortion.lost_area > policy.most_lost)) return;
    report.converged = report.converged && policy.done;
    report.warnings.insert(report.warnings.begin(),
                           {WarningKind::lost_area,
                            (policy.done ? "" : "not done: ") + formatted("%.3g", 100.0 * distortion.lost_area) +
                                " % of the surface's area is lost, " + counted(distortion.flipped.size(), "triangle") +
                                " without area or turned over as 32-bit UVs",
                            distortion.flipped, policy.advice});
}

void put_loss_first(std::vector<Warning>& warnings)
{
    std::stable_partition(warnings.begin(), warnings.end(),
                          [](const Warning& w) { return w.kind == WarningKind::lost_area; });
}

}  // namespace koebe
