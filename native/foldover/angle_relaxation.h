// Lowers the angle error vertex by vertex.
#pragma once

#include "foldover/angle_map.h"

namespace koebe {

/// Sweeps over all vertices that move. Each goes to where sum_k w_k e_k^2 over the corners of its faces is least to
/// first order, e_k the error of an angle and w_k = 1 / max(|e_k|, least), and beyond by over-relaxation. It stays if
/// the sum of |e_k| does not fall, a face would get too small, or it would pass a vertex of its loop. The map's errors
/// must be up to date, and are kept so.
/// @param least the least error in a weight, radians @param forward whether to go by rising vertex numbers
/// @return by how much the sum of all |e_k| fell
double relax_angles(AngleMap& map, double least, bool forward);

}  // namespace koebe
