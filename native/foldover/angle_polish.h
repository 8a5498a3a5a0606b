// A map with its circles as they are, of the least angle error the mesh can carry.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// Lowers the sum of |e| over all corners, e the angle of the map less that of the surface: the mean angle error
/// itself. Vertex by vertex (angle_relaxation.h), twice over; by Newton steps of all vertices for sum w e^2 with w near
/// 1 / |e| (angle_newton.h), more than one only as long as the error falls by a tenth; then vertex by vertex again, up
/// to 8 times over. No step takes the area of a face, nor a vertex past another of its loop. Vertices inside move
/// freely, those of the loops along their circles; those off their circles, around faces that are flipped, and what
/// fixes the map's position on the disk stay: one vertex of the outer loop, three if there is no other and none inside
/// is held. The circles do not change.
///
/// Around faces that would be flipped as stored, and on loops that would cross, vertices stay where they were. The
/// result is kept if the mean angle error is lower by a millionth of it.
/// @param loops the outer one first @param circles of the loops @param off_circle loop vertices off their circles
/// @param uv (V, 2) points of the unit disk, moved in place
/// @param held vertices that stay as well, one of the outer loop in the place of the one that would
/// @return whether it was kept
/// @throws Cancelled
bool polish_angles(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                   ExecutionContext& context, const std::vector<Index>& held = {});

}  // namespace koebe
