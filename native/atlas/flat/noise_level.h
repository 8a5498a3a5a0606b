// The noise of a surface: how far the faces of its planes lie beside them.
#pragma once

#include "flat/regions.h"

namespace koebe {

/// The planar regions of a surface, at its noise. The tolerance is that of stored coordinates. If few faces share a
/// plane then, larger tolerances are tried, up to 0.4 % of the diagonal of the surface's box. The first one is taken
/// for the noise at which large regions, whose edges bend to both sides, hold as much of the area as at the next two.
/// Where many faces share planes exactly, noise is slight at most.
PlanarRegions planar_regions(const CutSurface& surface);

}  // namespace koebe
