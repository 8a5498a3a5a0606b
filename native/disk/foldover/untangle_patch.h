// Selects neighbourhoods of flipped faces, and tries to turn the faces back.
#pragma once

#include "execution/execution.h"
#include "foldover/patch_shapes.h"
#include "foldover/repair_effort.h"
#include "foldover/tangled_map.h"

#include <vector>

namespace koebe {

/// The faces up to `rings` rings around some faces, in groups that share no mobile vertex.
std::vector<std::vector<Index>> patches_around(const TangledMap& map, const std::vector<Index>& faces, int rings,
                                               PatchBoundary boundary);

/// Minimizes on one patch with its edge held. Keeps the result if fewer of the patch's faces are tangled and no loop
/// crosses itself or another loop.
/// @return whether the result was kept
bool repair_patch(TangledMap& map, const std::vector<Index>& patch, PatchShape shape, PatchBoundary boundary,
                  RepairEffort& effort, const ExecutionContext& context);

/// Moves the two outer vertices of a face inward by inner_circle_tolerance. The face has all three vertices on the
/// outer loop, and its arc is so short that 32-bit UVs do not resolve the face.
/// @return whether fewer faces are tangled
bool nudge_face(TangledMap& map, Index face);

}  // namespace koebe
