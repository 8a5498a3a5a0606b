// Makes the polygons of a finished disk map convex.
#pragma once

#include "core/api.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <vector>

namespace koebe {

/// Makes polygons convex that are convex on the surface (mend_polygons), measures the map anew if anything has moved,
/// and warns of the polygons that stay concave. The centre, the point and all loops stay in place.
/// @param vertices, triangles of the map @param polygon (F) triangles of one number are one polygon; empty: no change
/// @param result in the numbers of the input @param mend false: only warns
KOEBE_API void make_polygons_convex(const Vertices& vertices, const Triangles& triangles,
                                    const std::vector<Index>& polygon, UniformizeResult& result,
                                    const ExecutionContext& context, bool mend = true);

}  // namespace koebe
