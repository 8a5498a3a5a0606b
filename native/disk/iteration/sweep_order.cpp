#include "iteration/sweep_order.h"

#include "core/errors.h"
#include "core/numbering.h"

#include <algorithm>
#include <string>
#include <utility>

namespace koebe {

Sweep fixed_sweep(int loop_count, Method method)
{
    Sweep sweep;
    if (method == Method::ck && loop_count != 2) {
        for (int k = 0; k < loop_count; ++k) sweep.push_back({k});
    } else if (method == Method::against_outer) {
        for (int k = 1; k < loop_count; ++k) sweep.push_back({0, k});
    } else {
        for (int k = 0; k + 1 < loop_count; k += 2) sweep.push_back({k, k + 1});
        if (loop_count % 2 == 1) sweep.push_back({0, loop_count - 1});
    }
    return sweep;
}

std::vector<Sweep> round_of_changing_pairs(int loop_count)
{
    const int seats = loop_count + loop_count % 2;  // one seat is empty for an odd number
    std::vector<int> seat = numbers_below<int>(seats);
    std::vector<Sweep> round;
    for (int turn = 0; turn + 1 < seats; ++turn) {
        Sweep sweep;
        int odd = -1;
        for (int s = 0; s < seats / 2; ++s) {
            const auto [low, high] = std::minmax(seat[s], seat[seats - 1 - s]);
            if (high == loop_count)
                odd = low;
            else
                sweep.push_back({low, high});
        }
        if (odd >= 0) sweep.push_back({0, std::max(odd, 1)});
        round.push_back(std::move(sweep));
        std::rotate(seat.begin() + 1, seat.end() - 1, seat.end());
    }
    return round;
}

void require_schedule(const Sweep& schedule, int loop_count, Method method)
{
    if (loop_count < 2) throw InputError("a surface with one boundary loop takes no schedule");
    const std::size_t opens = method == Method::ck && loop_count != 2 ? 1 : 2;
    std::vector<char> opened(loop_count, 0);
    // Each step opens as many loops as the method does, and different ones.
    for (const OpenedLoops& step : schedule) {
        if (step.size() != opens)
            throw InputError("a step of the schedule opens " + std::to_string(step.size()) + " loops, not " +
                             std::to_string(opens));
        for (const int k : step) {
            if (k < 0 || k >= loop_count)
                throw InputError("the schedule names loop " + std::to_string(k) + ", but the surface has loops 0 to " +
                                     std::to_string(loop_count - 1),
                                 ElementKind::loops, {k});
            opened[k] = 1;
        }
        if (step.front() == step.back() && opens == 2)
            throw InputError("a step of the schedule opens loop " + std::to_string(step.front()) + " twice",
                             ElementKind::loops, {step.front()});
        if (method == Method::against_outer && std::ranges::find(step, 0) == step.end())
            throw InputError("a step of the schedule fills loop 0, which this method never does", ElementKind::loops,
                             {0});
    }
    // A loop that is never opened would never become round.
    if (const auto missed = std::ranges::find(opened, 0); missed != opened.end())
        throw InputError("the schedule never opens loop " + std::to_string(missed - opened.begin()), ElementKind::loops,
                         {static_cast<Index>(missed - opened.begin())});
}

}  // namespace koebe
