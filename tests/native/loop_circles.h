// The circles in what a map reports of its loops.
#pragma once

#include "pipeline/result.h"

#include <vector>

namespace koebe::test {

inline std::vector<Circle> circles_of(const std::vector<LoopReport>& loops)
{
    std::vector<Circle> circles;
    for (const LoopReport& loop : loops) circles.push_back(loop.circle);
    return circles;
}

}  // namespace koebe::test
