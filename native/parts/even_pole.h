// The Moebius map of a part that makes its texels most even.
#pragma once

#include "core/types.h"

namespace koebe {

struct PartMap;

/// Moves a map by the Moebius map of least overflow: one of its circles, the outer one or a large hole's, goes onto the
/// unit circle, and the pole lies beyond it. u changes by log |M'|. Searched on a grid of poles and refined by halving
/// steps, over some 350 of the faces; those lost in rounding do not count.
/// @param areas (F) @param map moved in place: positions, centers, u, outer
void move_to_even_pole(const VectorXd& areas, PartMap& map);

}  // namespace koebe
