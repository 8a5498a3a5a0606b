// How an artist judges the UVs of a hard surface: flat regions whole and true to shape, straight edges along the axes.
#pragma once

#include "parts/layout.h"

namespace koebe {

struct HardFigures {
    Index regions = 0;     ///< planar regions of the surface with more than 1 % of the area
    double whole = 1.0;    ///< share of the area of these regions that lie in one part, similar to the region
    double aligned = 1.0;  ///< share of the length of straight outer edges in the UVs that lies along an axis
};

/// A planar region is faces that meet at edges bent by less than half a degree, and lie in one plane. Noise
/// (PartsLayout::noise) may bend the edges more, move vertices off the plane and their images off the similar ones.
/// Outer edges are the borders of the parts. An outer edge is straight if it is long, or goes on straight in space.
/// @param uv (3F, 2) as stored, in the layout's order
HardFigures hard_figures(const PartsLayout& layout, const PlanarPoints& uv);

}  // namespace koebe
