// Parts of surfaces that can be unfolded, as cones, rolled sheets and boxes.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "parts/flat_part.h"

namespace koebe {

/// The area of a face in the plane, negative if it is turned over.
double area_laid_flat(const PlanarPoints& points, const Triangles& triangles, Eigen::Index f);

/// Whether all faces are upright, and loops are simple, apart and not turned, in 64 bits.
bool lies_one_to_one(const FlatPart& part, const PlanarPoints& points);

/// Whether the angles round nearly all inner vertices sum to a whole turn.
bool is_bent_at_few_vertices(const Vertices& vertices, const Triangles& triangles);

/// Cuts the shortest way to the rim from each inner vertex where that is not so.
void cut_to_bends(FlatPart& part);

/// The part unfolded face by face, if it is one to one and less stretched so; then relaxed as long as that helps.
void unfold(FlatPart& part, ExecutionContext& context);

}  // namespace koebe
