#include "foldover/repair_effort.h"

#include "foldover/foldover_free.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr Eigen::Index step_overhead = 30;  // fixed cost of a Newton step, in faces
constexpr std::size_t fewest_steps = 10;
constexpr std::size_t steps_of_all = 30;   // steps of the whole surface
constexpr std::size_t small_steps = 2000;  // further steps for a small surface

}  // namespace

RepairEffort::RepairEffort(Eigen::Index faces, std::size_t small)
    : all_(steps_of_all * static_cast<std::size_t>(faces) +
           std::min(small, small_steps * static_cast<std::size_t>(faces))),
      most_(all_),
      limit_(all_)
{
}

void RepairEffort::renew() { limit_ = most_ = spent_ + all_; }

int RepairEffort::affordable(Eigen::Index faces) const
{
    const std::size_t steps = (limit_ - std::min(limit_, spent_)) /
                              static_cast<std::size_t>(std::max<Eigen::Index>(0, faces) + step_overhead);
    const auto most = static_cast<std::size_t>(FoldoverOptions{}.max_iterations);
    return steps < fewest_steps ? 0 : static_cast<int>(std::min(steps, most));
}

void RepairEffort::spend(Eigen::Index faces, int steps)
{
    spent_ += static_cast<std::size_t>(faces + step_overhead) * static_cast<std::size_t>(steps);
}

}  // namespace koebe
