// Where a part could be cut.
#pragma once

#include "evenness/part_map.h"
#include "execution/execution.h"
#include "splitting/dual_cut.h"

#include <vector>

namespace koebe {

struct Proposal {
    std::vector<Side> sides;  ///< (F) for minimum_cut
    double area = 0.0;        ///< of what is to be even
    const char* kind = "";
};

/// Windows of u, whose largest piece is to be an even disk; about tips and holes, in log polar coordinates, tubes, and
/// circles at their outer ends. @param threads as in side_by_side
std::vector<Proposal> proposals(const PartMesh& part, const PartMap& map, int threads, ExecutionContext& context);

}  // namespace koebe
