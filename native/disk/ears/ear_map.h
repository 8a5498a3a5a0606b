// Draws ears once the rest of the surface is mapped: into their hole, or onto the rim of the disk.
#pragma once

#include "core/types.h"
#include "ears/ears.h"
#include "execution/execution.h"

namespace koebe {

/// Draws every ear next to its hinge, and none over another face.
///
/// On the outer loop (loop 0) the ear's rim takes the arc between the ends of its hinge, evenly by length. Its inside
/// is harmonic; the segment is convex. On any other loop the ear lies in the hole, the convex polygon of the
/// shortened loop. It is flattened by the free-boundary least squares conformal map with the hinge pinned (Levy et al.
/// 2002). An ear that would leave the hole, overlap itself or meet another ear is made flatter; at last it is drawn in
/// the convex lens between its hinge and the middle of the hole, where it meets no other face.
/// @param uv (V, 2) of the surface; the core's vertices are given, the ears' are filled in
/// @param loops of the surface, the outer one first
/// @return the vertices off their loop's circle, in the ears' order
std::vector<Index> lay_ears(const Vertices& vertices, const Triangles& triangles, const std::vector<Ear>& ears,
                            const std::vector<VertexLoop>& loops, PlanarPoints& uv, const ExecutionContext& context);

}  // namespace koebe
