// Proposes cuts of a part.
#pragma once

#include "execution/execution.h"
#include "part_maps/part_map.h"
#include "splitting/dual_cut.h"

#include <vector>

namespace koebe {

struct Proposal {
    std::vector<Side> sides;  ///< (F) for minimum_cut
    double area = 0.0;        ///< area of the faces that are to be even
    const char* kind = "";
};

/// Proposes even disks: the largest piece of a window of u. Proposes tubes, in log polar
/// coordinates about tips and holes, and circles at the outer ends of the tubes. @param threads as in side_by_side
std::vector<Proposal> proposals(const PartMesh& part, const PartMap& map, int threads, ExecutionContext& context);

}  // namespace koebe
