// A surface whose mesh is too coarse for the iteration, on more triangles.
#pragma once

#include "pipeline/map_input.h"

namespace koebe {

/// Every face cut in four at the middles of its edges. The metric stays the same; every boundary vertex gets inner
/// neighbours, so that flux can run through it.
/// @return its first vertices are the surface's; every second vertex of a loop is one of the surface's, in their order
MapInput refined_input(const MapInput& input);

}  // namespace koebe
