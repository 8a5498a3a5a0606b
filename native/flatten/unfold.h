// Lays parts flat that can be unfolded: cones, rolled sheets, boxes.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "parts/flat_part.h"

namespace koebe {

/// Whether the angles round nearly all inner vertices sum to a whole turn.
bool is_bent_at_few_vertices(const Vertices& vertices, const Triangles& triangles);

/// Cuts the shortest way to the rim from each inner vertex where they do not.
void cut_to_bends(FlatPart& part);

/// Unfolds the part face by face, and takes the result if it is one to one and less stretched. Then relaxes it as long
/// as that helps.
void unfold(FlatPart& part, ExecutionContext& context);

}  // namespace koebe
