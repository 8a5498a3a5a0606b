// Importance of vertices: how large faces should be beside each other in the UVs.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// Texel density (a length over a length) at importance 1 over that at importance 0.
inline constexpr double most_important = 4.0;

/// (F) factor of each face's area by its importance: most_important^(2 w), w the mean over its vertices.
VectorXd importance_factors(const Triangles& triangles, const VectorXd& importance);

/// (F) the factors, scaled so that the area of the surface stays the same. Empty if importance is empty, or the same
/// at all vertices of faces.
/// @param vertices (V, 3) @param importance (V) from 0 to 1, or empty
VectorXd size_factors(const Vertices& vertices, const Triangles& triangles, const VectorXd& importance);

/// @throws InputError importance that nothing weighs: it needs a map that is made more even, or a balance
void require_use_of_importance(const std::vector<double>& importance, double even, bool balanced = false);

}  // namespace koebe
