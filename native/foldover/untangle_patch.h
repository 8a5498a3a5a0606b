// Neighbourhoods of flipped faces, and the attempts to turn them back.
#pragma once

#include "execution/execution.h"
#include "foldover/patch_shapes.h"
#include "foldover/repair_effort.h"
#include "foldover/tangled_map.h"

#include <vector>

namespace koebe {

/// The faces around some, `rings` rings wide, in groups that touch in no mobile vertex.
std::vector<std::vector<Index>> patches_around(const TangledMap& map, const std::vector<Index>& faces, int rings,
                                               PatchBoundary boundary);

/// Minimizes on one patch, all that lies on its edge held; keeps the result if fewer of its faces are tangled and
/// no loop crosses itself or another.
/// @return whether it was kept
bool repair_patch(TangledMap& map, const std::vector<Index>& patch, PatchShape shape, PatchBoundary boundary,
                  RepairEffort& effort, const ExecutionContext& context);

/// A face with all three vertices on the outer loop is as thin as its arc: where that is less than 32-bit UVs
/// resolve, its two outer ones go inward by inner_circle_tolerance.
/// @return whether fewer faces are tangled
bool nudge_face(TangledMap& map, Index face);

}  // namespace koebe
