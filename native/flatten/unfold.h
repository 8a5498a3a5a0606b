// Parts of surfaces that can be unfolded, as cones, rolled sheets and boxes.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "parts/flat_part.h"

namespace koebe {

/// Whether the angles round nearly all inner vertices sum to a whole turn.
bool is_bent_at_few_vertices(const Vertices& vertices, const Triangles& triangles);

/// Cuts the shortest way to the rim from each inner vertex where that is not so.
void cut_to_bends(FlatPart& part);

/// The part unfolded face by face, if it is one to one and less stretched so; then relaxed as long as that helps.
void unfold(FlatPart& part, ExecutionContext& context);

}  // namespace koebe
