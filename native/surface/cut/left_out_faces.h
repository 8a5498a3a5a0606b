// Finds faces that cannot be part of a surface.
#pragma once

#include "cut/open_surface.h"

#include <vector>

namespace koebe {

/// Finds faces that name a vertex twice, and faces with the three vertices of an earlier face. A polygon is a duplicate
/// only as a whole: if all its faces duplicate faces of one other polygon.
/// @param polygon (F) or empty, as in OpenOptions
std::vector<LeftOutFace> left_out_faces(const Triangles& triangles, Index vertex_count,
                                        const std::vector<Index>& polygon);

}  // namespace koebe
