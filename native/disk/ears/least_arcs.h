// How much of the unit circle each boundary edge needs, so that ears on it can be drawn in 32-bit UVs.
#pragma once

#include "ears/ears.h"

namespace koebe {

/// The least angle for each edge of the outer loop, from a vertex to the next. Ears carry no flux, so a conformal map
/// gives them no room. Drawn along the circle they are as thin as its arc: a face of three neighbours s apart is s^2 /
/// 2 high. So the hinge of an ear of several faces takes 1e-3 for each of the ear's edges. The same takes each edge of
/// a part joined by one edge that is no ear, as it has other loops in it. Any other edge takes 1e-3 of the mean
/// edge.
/// @param core, outer the surface without ears and its outer loop @param ears, core_vertices as in EarCut; the
/// latter is empty if there are no ears
VectorXd least_arcs(const Surface& core, const VertexLoop& outer, const std::vector<Ear>& ears,
                    const std::vector<Index>& core_vertices);

}  // namespace koebe
