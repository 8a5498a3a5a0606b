// Lowers the angle error of a map as far as its mesh allows, with the circles unchanged.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Lowers the sum of |e| over all corners: the mean angle error. e is the angle in the map minus the angle on the
/// surface. Moves vertex by vertex (angle_relaxation.h), two sweeps. Then Newton steps of all vertices for sum w e^2
/// with w near 1 / |e| (angle_newton.h), repeated as long as the error falls by a tenth. Then vertex by vertex again,
/// up to 8 sweeps. No step turns a face over, or moves a vertex past another vertex of its loop. Inner vertices move
/// freely, loop vertices along their circles. Some vertices stay: vertices off their circles, vertices of flipped
/// faces, and vertices that fix the map's position. The position is fixed by one vertex of the outer loop, or by three
/// if there is no other loop and no inner vertex is held. The circles do not change.
///
/// Vertices of faces that would be flipped as stored, and of loops that would cross, return to their old places. The
/// result is kept if the mean angle error falls by at least a millionth.
/// @param loops the outer loop first @param circles of the loops @param off_circle loop vertices off their circles
/// @param uv (V, 2) points of the unit disk, moved in place
/// @param held more vertices that stay; if an outer-loop vertex is among them, this vertex fixes the position
/// @return whether the result was kept
/// @throws Cancelled
bool polish_angles(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                   ExecutionContext& context, const std::vector<Index>& held = {});

}  // namespace koebe
