#include "pipeline/loop_numbers.h"

#include <algorithm>
#include <utility>

namespace koebe {

std::vector<Warning> with_loops_renumbered(const UniformizeResult& disk, const std::vector<const LoopReport*>& order,
                                           std::initializer_list<WarningKind> left_out)
{
    std::vector<Warning> result;
    for (Warning warning : disk.warnings) {
        if (std::ranges::find(left_out, warning.kind) != left_out.end()) continue;
        if (elements_of(warning.kind) == ElementKind::loops) {
            for (Index& k : warning.elements)
                k = static_cast<Index>(std::ranges::find(order, &disk.loops.at(k)) - order.begin());
            std::ranges::sort(warning.elements);
        }
        result.push_back(std::move(warning));
    }
    return result;
}

}  // namespace koebe
