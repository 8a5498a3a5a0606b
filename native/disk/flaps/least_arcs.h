// How much of the unit circle each boundary edge needs, so that flaps on it can be drawn in 32-bit UVs.
#pragma once

#include "flaps/flaps.h"

namespace koebe {

/// The least angle for each edge of the outer loop, from a vertex to the next. Flaps carry no flux, so a conformal map
/// gives them no room. Drawn along the circle they are as thin as its arc: a face of three neighbours s apart is s^2 /
/// 2 high. So the hinge of a flap of several faces takes 1e-3 for each of the flap's edges. The same takes each edge of
/// a part that hangs by an edge but is no flap, as it has other loops in it. Any other edge takes 1e-3 of the mean
/// edge.
/// @param core, outer the surface without flaps and its outer loop @param flaps, core_vertices as in FlapCut; the
/// latter is empty if there are no flaps
VectorXd least_arcs(const Surface& core, const VertexLoop& outer, const std::vector<Flap>& flaps,
                    const std::vector<Index>& core_vertices);

}  // namespace koebe
