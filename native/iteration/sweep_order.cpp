#include "iteration/sweep_order.h"

namespace koebe {

std::vector<std::pair<int, int>> sweep_pairs(int loop_count, Method method)
{
    std::vector<std::pair<int, int>> pairs;
    if (method == Method::ck) {
        for (int k = 1; k < loop_count; ++k) pairs.emplace_back(0, k);
    } else {
        for (int k = 0; k + 1 < loop_count; k += 2) pairs.emplace_back(k, k + 1);
        if (loop_count % 2 == 1) pairs.emplace_back(0, loop_count - 1);
    }
    return pairs;
}

std::vector<std::vector<OpenedLoops>> sweep_order(int loop_count, Method method, bool at_once)
{
    std::vector<OpenedLoops> steps;
    if (method == Method::ck && loop_count > 2)
        for (int k = 0; k < loop_count; ++k) steps.push_back({k});
    else
        for (const auto& [i, j] : sweep_pairs(loop_count, Method::gk)) steps.push_back({i, j});
    if (at_once) return {steps};
    std::vector<std::vector<OpenedLoops>> order;
    for (const OpenedLoops& step : steps) order.push_back({step});
    return order;
}

}  // namespace koebe
