// The energy of each face in an even map, and its forces at the corners.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

struct EvenForces {
    VectorXd energy;                           ///< (F) A ((s1^2 + s2^2) / (s1 s2) - 2 + t (s1 s2 + 1 / (s1 s2) - 2))
    std::vector<std::array<Complex, 3>> pull;  ///< (F) minus the gradient of the energy by the places of the corners
};

/// The terms of E_t (even/even_map.h), face by face.
/// @param vertices (V, 3) in the unit of the points @param triangles (F, 3) @param points (V, 2) without flipped faces
/// @param even E, 0 to 1 @param sizes as in FlatSurface
EvenForces even_forces(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points, double even,
                       const VectorXd& sizes = {});

}  // namespace koebe
