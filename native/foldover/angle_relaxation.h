// The angle error lowered vertex by vertex.
#pragma once

#include "foldover/angle_map.h"

namespace koebe {

/// A sweep over all vertices that move. Each goes to where sum_k w_k e_k^2 over the corners of its faces is least to
/// first order, e_k the error of an angle and w_k = 1 / max(|e_k|, least), and past that by over-relaxation; it stays
/// if the sum of |e_k| does not fall there, or a face would get too small, or it would pass a vertex of its loop. The
/// map's errors have to be up to date, and are afterwards.
/// @param least error at which a weight is taken, radians @param forward whether the vertices rise
/// @return by how much the sum of all |e_k| fell
double relax_angles(AngleMap& map, double least, bool forward);

}  // namespace koebe
