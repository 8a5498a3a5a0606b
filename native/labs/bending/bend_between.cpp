#include "bending/bend_between.h"

#include "bending/circle_path.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace koebe {

BendingResult bend_between(const BendingInput& input, const std::vector<Circle>& from, const std::vector<Circle>& to,
                           const Extremal& extremal, ExecutionContext& context)
{
    constexpr std::size_t most_paths = 4;  // that are tried
    const std::vector<CirclePath> paths = paths_between(from, to);
    BendingResult best;
    for (std::size_t i = 0; i < std::min(paths.size(), most_paths); ++i) {
        BendingResult result = bend_along(input, paths[i], extremal, context);
        result.straight = paths[i].straight();
        if (result.arrived) return result;
        if (i == 0 || result.reached > best.reached) best = std::move(result);
    }
    return best;
}

}  // namespace koebe
