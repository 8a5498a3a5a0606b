// Lowers the angle error of a map as far as its mesh allows, with the circles unchanged.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Lowers the sum of |e| over all corners: the mean angle error. e is the angle in the map minus that on the surface.
/// Moves vertex by vertex (angle_relaxation.h), two sweeps. Then Newton steps of all vertices for sum w e^2 with w near
/// 1 / |e| (angle_newton.h), repeated as long as the error falls by a tenth. Then vertex by vertex again, up to 8
/// sweeps. No step turns a face over, or moves a vertex past another of its loop. Inner vertices move freely, loop
/// vertices along their circles. Vertices off their circles, around flipped faces, and those that fix the map's
/// position stay: one vertex of the outer loop, or three if there is no other loop and no inner vertex is held. The
/// circles do not change.
///
/// Vertices around faces that would be flipped as stored, and on loops that would cross, return to where they were. The
/// result is kept if the mean angle error falls by at least a millionth.
/// @param loops the outer one first @param circles of the loops @param off_circle loop vertices off their circles
/// @param uv (V, 2) points of the unit disk, moved in place
/// @param held more vertices that stay; an outer-loop vertex among them fixes the position instead of another
/// @return whether the result was kept
/// @throws Cancelled
bool polish_angles(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                   ExecutionContext& context, const std::vector<Index>& held = {});

}  // namespace koebe
