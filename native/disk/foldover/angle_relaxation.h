// Lowers the angle error vertex by vertex.
#pragma once

#include "foldover/angle_map.h"

namespace koebe {

/// Sweeps over all vertices that move. For each vertex it minimizes sum_k w_k e_k^2 over the corners of the vertex's
/// faces, to first order and with over-relaxation. e_k is the error of an angle, and w_k = 1 / max(|e_k|, least). A
/// vertex stays if the sum of |e_k| would not fall, a face would get too small, or the vertex would pass another vertex
/// of its loop. The map's errors must be up to date before the call, and are so afterwards.
/// @param least the least error in a weight, radians @param forward true: by ascending vertex numbers
/// @return the sum of all |e_k| before the sweep minus this sum after it
double relax_angles(AngleMap& map, double least, bool forward);

}  // namespace koebe
