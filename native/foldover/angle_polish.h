// A map with its circles as they are, of the least angle error the mesh can carry.
#pragma once

#include "circles/circle.h"
#include "core/execution.h"
#include "core/topology.h"

#include <vector>

namespace koebe {

/// Minimizes sum_f w_f tr(J'J) / det J over all faces of a map without flips, J the linear map from the face on the
/// surface to its image: tr(J'J) / det J = 2 (1 + |mu|^2) / (1 - |mu|^2), whatever its size (Hormann and Greiner 2000,
/// "MIPS"), and w_f is taken anew before each Newton step so that it is the sum of |mu| that falls. Vertices inside
/// move freely, those of the loops along their circles; those off their circles and what fixes the map's position on
/// the disk stay: one vertex of the outer loop, three if there is no other and none inside is held. The circles do not
/// change.
///
/// Against the conformal energy, which weighs a face by its area in the plane, this is fair to limbs and to the coarse
/// rim alike. The result is kept if the mean angle error is lower, no more faces are flipped, and every loop keeps its
/// order.
/// @param loops the outer one first @param circles of the loops @param off_circle loop vertices off their circles
/// @param uv (V, 2) points of the unit disk, moved in place
/// @param held vertices that stay as well, one of the outer loop in the place of the one that would
/// @return whether it was kept
/// @throws Cancelled
bool polish_angles(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                   ExecutionContext& context, const std::vector<Index>& held = {});

}  // namespace koebe
