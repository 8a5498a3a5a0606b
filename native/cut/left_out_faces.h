// Faces that no surface has room for.
#pragma once

#include "cut/open_surface.h"

#include <vector>

namespace koebe {

/// Faces that name a vertex twice, and those with the three vertices of an earlier face. Of polygons only whole ones
/// are duplicates: all their faces are those of one other polygon.
/// @param polygon (F) or empty, as in OpenOptions
std::vector<LeftOutFace> left_out_faces(const Triangles& triangles, Index vertex_count,
                                        const std::vector<Index>& polygon);

}  // namespace koebe
