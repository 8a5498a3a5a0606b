// Loose strips: long straight strips, such as chamfers, that would leave their plates and follow each other round
// corners.
#pragma once

#include "flat/regions.h"
#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

/// Half-edges of a chart, one each, between loose strips and their neighbours in the chart. A loose strip is a planar
/// piece that has a straight border with a larger planar region outside, is joined with its chart along short edges
/// only, and is much longer than the pieces there, or turned against them. Where charts run straight on they are not
/// loose: the rim of a lid is one strip.
/// @param chart of a net that has faces of the surface as its faces @param at (3F of the surface) the chart as laid
std::vector<Index> edges_of_loose_strips(const CutSurface& surface, const PlanarRegions& regions,
                                         const SeamedMesh& chart, const std::vector<Complex>& at);

}  // namespace koebe
